"""Scenes for mitsuba_parameter_scenes.py: values that volumes give, sensors that measure, batches, and beams."""
import math

from mitsuba_scene_parts import (BOX, LAMP, LAMP_PLACE, LOOK, PATH, SKY, VOLPATH, area, ball, boolean, bsdf, camera, element,
                                 emitter, film, grey, integer, number, place, point, rgb, scene, shape, string, texture,
                                 vector)

TURN = place('<scale value="0.6"/>', '<rotate y="1" angle="40"/>', '<translate x="0.2" y="0.4"/>')
PIXEL = element("film", "hdrfilm", integer("width", 1), integer("height", 1), BOX, string("pixel_format", "rgb"))


def volume(name, file, *content):
    return element("volume", "gridvolume", string("filename", file), *content, name=name)


WHOLE = boolean("use_grid_bbox")


def fog(*content):
    return scene(ball(bsdf("null"), element("medium", "homogeneous", rgb("sigma_t", "1,0.75,0.5"), number("scale", 2), *content,
                                            name="interior")), integrator=VOLPATH)


def volume_value_cases():
    """(name, scene)"""
    yield "medium homogeneous albedo volume", fog(volume("albedo", "coloured.vol", WHOLE))
    yield "medium homogeneous albedo placed", fog(volume("albedo", "smoke.vol", string("filter_type", "nearest"), place(
        '<scale x="0.5" y="0.9" z="0.6"/>', '<rotate y="1" angle="25"/>', '<translate x="-0.3" y="-0.2" z="-0.5"/>')))
    lobes = element("phase", "hg", number("g", 0.9)) + element("phase", "hg", number("g", -0.6))
    yield "medium blendphase weight volume", fog(element("phase", "blendphase", volume("weight", "smoke.vol", WHOLE), lobes))
    cloud = element("medium", "heterogeneous", volume("sigma_t", "smoke.vol", WHOLE), number("scale", 6), element(
        "phase", "blendphase", volume("weight", "smoke.vol", WHOLE, string("wrap_mode", "mirror")), lobes), name="interior")
    yield "medium heterogeneous blendphase weight volume", scene(ball(bsdf("null"), cloud), integrator=VOLPATH)

    def painted(*content):
        return texture("reflectance", "volume", *content)
    for name, content in (("smoke", volume("volume", "smoke.vol", WHOLE)), ("coloured", volume("volume", "coloured.vol", WHOLE)),
                          ("placed", volume("volume", "coloured.vol", string("wrap_mode", "repeat"), place(
                              '<scale value="0.5"/>', '<rotate x="1" angle="20"/>'))),
                          ("constvolume", element("volume", "constvolume", rgb("value", "0.2,0.5,0.1"), name="volume"))):
        yield f"texture volume {name}", scene(ball(bsdf("diffuse", painted(content))))
    mesh = shape("ply", string("filename", "mesh.ply"), TURN, bsdf("twosided", bsdf("diffuse", painted(
        volume("volume", "coloured.vol", WHOLE)))))
    yield "texture volume on a mesh", scene(mesh)
    yield "texture volume of instances", scene(
        shape("shapegroup", mesh.replace("<shape ", '<shape id="member" ', 1), id="group"),
        *(shape("instance", place(f'<translate x="{x}" z="{-x}"/>'), '<ref id="group"/>') for x in (-0.5, 0.6)))
    yield "texture volume as a weight", scene(ball(bsdf("blendbsdf", texture("weight", "volume", volume(
        "volume", "smoke.vol", WHOLE)), grey(0.9), grey(0.1))))
    yield "texture volume as alpha", scene(ball(bsdf("roughconductor", texture("alpha", "volume", volume(
        "volume", "smoke.vol", WHOLE)))))
    yield "attribute of a sphere", scene(ball(texture("vertex_paint", "checkerboard", rgb("color0", "0.9,0.5,0.1")), bsdf(
        "diffuse", texture("reflectance", "mesh_attribute", string("name", "vertex_paint"), number("scale", 0.8)))))
    lamp = element("spectrum", "d65", texture("nested", "checkerboard", rgb("color0", "0.9,0.5,0.1")), name="radiance")
    yield "spectrum d65 of a texture", scene(ball(grey(0.7)), lights=SKY + shape("rectangle", LAMP_PLACE, area(lamp)))


def meter(kind, *content, **rest):
    return scene(ball(grey(0.8)), sensor=element("sensor", kind, *content, PIXEL), **rest)


def meter_cases():
    """(name, scene)"""
    ray = point("origin", "0.5,1.2,5") + vector("direction", "-0.1,-0.18,-1")
    yield "radiancemeter", meter("radiancemeter", LOOK)
    yield "radiancemeter origin and direction", meter("radiancemeter", ray)
    yield "radiancemeter by volpath", meter("radiancemeter", ray, integrator=VOLPATH)
    down = vector("direction", "0.1,-1,-0.3")
    yield "distant", meter("distant")
    yield "distant direction", meter("distant", down)
    yield "distant to_world", meter("distant", place('<rotate x="1" angle="70"/>', '<rotate y="1" angle="20"/>'))
    yield "distant target point", meter("distant", down, point("target", "0.1,0.9,0.2"))
    for kind in ("rectangle", "disk"):
        yield f"distant target {kind}", meter("distant", down, shape(kind, place(
            '<scale x="1.2" y="0.7"/>', '<rotate x="1" angle="-60"/>', '<translate y="0.3"/>'), name="target"))
    inside = element("sensor", "irradiancemeter", PIXEL)
    for kind, content in (("rectangle", ""), ("disk", ""), ("rectangle flip_normals", boolean("flip_normals"))):
        where = place('<scale x="0.4" y="0.6"/>', '<rotate x="1" angle="-70"/>', '<translate x="0.3" y="1.5"/>')
        yield f"irradiancemeter {kind}", scene(ball(grey(0.8)), sensor=shape(kind.split()[0], where, content, inside, grey(0.3)))
    yield "irradiancemeter by volpath", scene(ball(grey(0.8)), integrator=VOLPATH, sensor=shape(
        "rectangle", place('<translate y="2"/>'), inside))
    poses = [element("sensor", kind, content, place(look)) for kind, content, look in (
        ("perspective", number("fov", 40), '<lookat origin="0.5,1.2,5" target="0,0.3,0" up="0,1,0"/>'),
        ("thinlens", number("fov", 50) + number("aperture_radius", 0.2) + number("focus_distance", 4),
         '<lookat origin="-3,1.2,3" target="0,0.3,0" up="0,1,0"/>'),
        ("orthographic", "", '<scale value="1.5"/><lookat origin="0,5,0.1" target="0,0,0" up="0,0,1"/>'))]
    yield "batch", scene(ball(grey(0.8)), sensor=element("sensor", "batch", *poses, film(width=72, height=24)))
    yield "batch with a wide filter", scene(ball(grey(0.8)), sensor=element("sensor", "batch", *poses[:2], film(
        width=64, height=48, rfilter=element("rfilter", "gaussian", number("stddev", 1)))))


def beam_cases():
    """(name, scene)"""
    tracer = element("integrator", "ptracer")
    for kind in ("rectangle", "disk"):
        yield f"directionalarea {kind}", scene(ball(grey(0.8)), integrator=tracer, lights=shape(kind, LAMP_PLACE, emitter(
            "directionalarea", rgb("radiance", "8,6,4"))))
    yield "directionalarea beside a lamp", scene(ball(bsdf("conductor")), integrator=tracer, lights=LAMP + shape(
        "rectangle", place('<scale x="0.3" y="0.8"/>', '<lookat origin="-2,2,1" target="0,0.3,0" up="0,1,0"/>'),
        emitter("directionalarea", rgb("radiance", "8,6,4"))))


def beam_departures():
    """(name, scene, closed form of the mean, its derivation)"""
    floor = shape("rectangle", place('<scale value="4"/>'), grey(0.5))
    beam = shape("rectangle", place('<scale value="2"/>', '<rotate x="1" angle="180"/>', '<translate z="8"/>'), emitter(
        "directionalarea", number("radiance", 3)))
    look = place('<lookat origin="0,0,5" target="0,0,0" up="0,1,0"/>')
    yield ("directionalarea by path", scene(floor, beam, integrator=PATH, floor="", lights="", sensor=camera(
        kind="orthographic", fov="", to_world=look)), 0.5 * 3 / math.pi,
           "albedo / pi times the irradiance of the beam, which `ptracer` of both programs gives")
