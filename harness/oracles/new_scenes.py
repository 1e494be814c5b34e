#!/usr/bin/env python3
"""Writes scenes in the words of Mitsuba 3.9: every plugin of its documentation with each of its parameters, and every way
to write a value, a file each.

    python3 harness/oracles/new_scenes.py FOLDER && harness/oracles/census.sh FOLDER
    PYTHON harness/oracles/mitsuba_parameters.py PROGRAM -o OUT --folder FOLDER

The first line counts which of them load, the second compares their images with Mitsuba's. Left out are `measured` and
`measured_polarized`, whose data is not free to copy, and what takes arrays of Python alone (`blender`).
"""

import sys
from pathlib import Path

import mitsuba_scene_parts as parts
from mitsuba_scene_parts import BOX, LAMP_PLACE, LOOK, PATH, SKY, VOLPATH
from new_scene_files import write_files
from new_scene_tables import *

BALL = ball(grey(0.8))
WITHOUT_UV = ("bsplinecurve", "linearcurve", "sdfgrid", "ellipsoids", "ellipsoidsmesh")

# ---- sensors, integrators, films: a scene for each content ------------------------------------------------------------------

CLIPS = numbers(near_clip=0.1, far_clip=99)
SHUTTER = numbers(shutter_open=0, shutter_close=1)
SENSORS = {
    "perspective": [
        "",
        number("fov", 40) + CLIPS,
        *(number("fov", 30) + string("fov_axis", w) for w in ("x", "y", "diagonal", "smaller", "larger")),
        string("focal_length", "70mm"),
        numbers(fov=40, principal_point_offset_x=0.1, principal_point_offset_y=-0.2),
        number("fov", 40) + SHUTTER,
    ],
    "thinlens": [
        number("aperture_radius", 0.2) + c
        for c in (
            number("fov", 40),
            numbers(fov=40, focus_distance=5),
            number("fov", 40) + CLIPS,
            number("fov", 40) + string("fov_axis", "y") + number("focus_distance", 5),
            string("focal_length", "50mm") + number("focus_distance", 5),
            number("fov", 40) + SHUTTER,
        )
    ],
    "orthographic": ["", CLIPS, SHUTTER],
    "radiancemeter": ["", point("origin", "0.5,1.2,5") + vector("direction", "-0.1,-0.18,-1")],
    "distant": [
        vector("direction", "0,-1,-0.3"),
        vector("direction", "0,-1,-0.3") + point("target", "0,0.3,0"),
        vector("direction", "0,-1,-0.3") + shape("rectangle", SMALL, name="target"),
        "",
    ],
}

PATHS = ["", integer("max_depth", 3), integer("rr_depth", 2), boolean("hide_emitters")]
PRB = ["", integer("max_depth", 3), integer("rr_depth", 2)]
INTEGRATORS = {
    "direct": [
        "",
        integer("shading_samples", 2),
        integer("emitter_samples", 2) + integer("bsdf_samples", 3),
        boolean("hide_emitters"),
    ],
    "path": PATHS,
    "volpath": PATHS,
    "volpathmis": [*PATHS, boolean("use_spectral_mis", False)],
    "ptracer": ["", integer("max_depth", 3), integer("rr_depth", 2), integer("samples_per_pass", 4)],
    "aov": [
        string("aovs", "dd.y:depth,nn:sh_normal") + PATH,
        string("aovs", "a:albedo,p:position,u:uv,g:geo_normal,s:shape_index,i:prim_index,du:dp_du,dv:dp_dv,dx:duv_dx,dy:duv_dy")
        + PATH,
        string("aovs", "dd:depth"),
    ],
    "depth": [""],
    "moment": [PATH, integrator("direct", name="inner")],
    "stokes": [PATH],
    "prb": [*PRB, boolean("hide_emitters")],
    "prb_basic": PRB,
    "prbvolpath": PRB,
    "prb_projective": [*PRB, string("guiding", "none")],
    "direct_projective": ["", integer("sppc", 16) + integer("sppp", 16) + integer("sppi", 16)],
    "volprim_rf_basic": [""],
    "path timeout": [number("timeout", 100)],
    "path block_size": [integer("block_size", 16)],
    "path samples_per_pass": [integer("samples_per_pass", 4)],
}
CROP = "".join(integer(f"crop_{k}", v) for k, v in (("offset_x", 4), ("offset_y", 6), ("width", 20), ("height", 12)))
FILMS = {
    "hdrfilm": [
        "",
        *(string("pixel_format", w) for w in ("luminance", "luminance_alpha", "rgb", "rgba", "xyz", "xyza")),
        *(string("component_format", w) for w in ("float16", "float32", "uint32")),
        *(string("file_format", w) for w in ("openexr", "exr", "rgbe", "pfm")),
        CROP,
        boolean("sample_border"),
        boolean("compensate"),
        boolean("banner", False),
    ],
    "specfilm": [
        spectrum("band1_red", "400:0, 600:1, 700:0.5") + spectrum("band2_blue", "400:0.6, 500:1, 600:0") + c
        for c in ("", string("component_format", "float32"))
    ],
}
FILTERS = {
    "box": [""],
    "tent": ["", number("radius", 2)],
    "gaussian": ["", number("stddev", 0.8)],
    "mitchell": ["", numbers(B=0.2, C=0.6)],
    "catmullrom": [""],
    "lanczos": ["", integer("lobes", 2)],
}
SAMPLERS = {
    kind: [integer("sample_count", 16), integer("sample_count", 16) + integer("seed", 3)]
    for kind in ("independent", "stratified", "multijitter", "orthogonal", "ldsampler")
}
JITTER = {
    kind: [integer("sample_count", 16) + boolean("jitter", False)] for kind in ("stratified", "multijitter", "orthogonal")
}


# ---- plugins ----------------------------------------------------------------------------------------------------------------


def on_ball(kind, content):
    if kind == "hair":
        return scene(shape("bsplinecurve", string("filename", "curves.txt"), bsdf(kind, content)))
    return scene(ball(bsdf(kind, content)))


def of_index(kind, name):
    return scene(ball(bsdf(kind, string("int_ior", name), number("ext_ior", 1.2))))


def shining(kind, content):
    light = emitter(kind, content)
    return scene(ball(grey(0.7)), lights=shape("rectangle", LAMP_PLACE, light) if kind in SHINING else light)


def formed(kind, content):
    return scene(shape(kind, content, grey(0.6) if kind in WITHOUT_UV else PAINT))


def filling(kind, content):
    return foggy(element("medium", kind, content, name="interior"))


def scattering(kind, content):
    return filling("homogeneous", THICK + element("phase", kind, content))


def varying(kind, content):
    return filling("heterogeneous", volume("sigma_t") + number("scale", 4) + element("volume", kind, content, name="albedo"))


def seen_by(kind, content):
    meter = kind in ("radiancemeter", "distant")
    where = "" if meter and content else LOOK
    return scene(BALL, sensor=camera(content, kind=kind, fov="", to_world=where, film=small_film() if meter else film()))


def computed_by(kind, content):
    body = shape("ellipsoids", string("filename", "splats.ply")) if kind == "volprim_rf_basic" else BALL
    return scene(body, integrator=integrator(kind, content), **(dict(lights=parts.LAMP) if kind == "ptracer" else {}))


def filmed(kind, content):
    return scene(BALL, sensor=camera(film=film(content, kind=kind)))


def filtered(kind, content):
    return scene(BALL, sensor=camera(film=film(rfilter=element("rfilter", kind, content))))


def plugin_scenes():
    """(name of the file, text)"""
    for kind, plugins, text in (
        ("bsdf", BSDFS, on_ball),
        ("bsdf", {"dielectric named": INDICES}, of_index),
        ("texture", TEXTURES, textured),
        ("emitter", EMITTERS, shining),
        ("shape", SHAPES, formed),
        ("medium", MEDIA, filling),
        ("phase", PHASES, scattering),
        ("volume", VOLUMES, varying),
        ("sensor", SENSORS, seen_by),
        ("integrator", INTEGRATORS, computed_by),
        ("film", FILMS, filmed),
        ("rfilter", FILTERS, filtered),
        ("sampler", SAMPLERS, sampled),
        ("sampler-jitter", JITTER, sampled),
    ):
        for plugin, contents in plugins.items():
            for i, content in enumerate(contents):
                yield f"{kind}-{plugin.replace(' ', '-')}-{i:02d}", text(plugin.split()[0], content)
    room = shape("cube", place('<scale value="7"/>'), boolean("flip_normals"), grey(0.8))
    for kind in ("path", "prb", "prb_basic", "prbvolpath", "prb_projective", "direct_projective"):
        yield f"integrator-{kind}-closed", scene(BALL, room, integrator=integrator(kind), lights=parts.LAMP)
    plain = element("film", "hdrfilm", integer("width", 32), integer("height", 24))
    yield "film-default", scene(BALL, sensor=camera(film=plain))
    meter = element("sensor", "irradiancemeter", small_film())
    yield "sensor-irradiancemeter", scene(BALL, sensor=shape("rectangle", place('<translate y="2"/>'), meter))
    pose = camera(film="", fov=number("fov", 30))
    yield "sensor-batch", scene(BALL, sensor=element("sensor", "batch", pose, pose, film()))
    fog = element("medium", "homogeneous", number("sigma_t", 0.05))
    yield "sensor-medium", scene(BALL, integrator=VOLPATH, lights=parts.LAMP, sensor=camera(fog))


def small_film():
    return element("film", "hdrfilm", integer("width", 1), integer("height", 1), BOX, string("pixel_format", "rgb"))


def sampled(kind, content):
    return scene(ball(grey(0.8)), sensor=camera(sampler=element("sampler", kind, content)))


def textured(kind, content):
    if kind == "bitmap" and "filename" not in content:
        content = string("filename", "picture.png") + content
    reflectance = bsdf(
        "diffuse",
        (
            texture("reflectance", kind, content)
            if kind in ("bitmap", "checkerboard", "mesh_attribute", "volume")
            else element("spectrum", kind, content, name="reflectance")
        ),
    )
    return scene(shape("ply", string("filename", "painted.ply"), TURN, bsdf("twosided", reflectance)))


def foggy(medium, **rest):
    return scene(ball(bsdf("null"), medium), integrator=VOLPATH, **rest)


# ---- ways of writing --------------------------------------------------------------------------------------------------------

STEPS = (
    '<translate x="0.3" y="0.2" z="-0.5"/>',
    '<translate value="0.3,0.2,-0.5"/>',
    '<translate value="0.3 0.2 -0.5"/>',
    '<translate y="0.2"/>',
    '<scale value="0.7"/>',
    '<scale value="0.7,0.5,0.6"/>',
    '<scale value="0.7 0.5 0.6"/>',
    '<scale x="0.7" y="0.5"/>',
    '<rotate x="1" angle="30"/>',
    '<rotate x="0" y="1" z="0" angle="30"/>',
    '<rotate value="0,1,0" angle="30"/>',
    '<rotate value="0 1 0" angle="3e1"/>',
    '<rotate angle="-30" z="1"/>',
    '<matrix value="0.5 0.1 0 0.2 0 0.6 0.2 0.3 -0.1 0 0.7 0 0 0 0 1"/>',
    '<matrix value="0.5, 0.1, 0, 0.2, 0, 0.6, 0.2, 0.3, -0.1, 0, 0.7, 0, 0, 0, 0, 1"/>',
    '<matrix value="0.5 0.1 0\n 0 0.6 0.2\n  -0.1 0 0.7"/>',
    '<lookat origin="0,0.3,0" target="1,1,2" up="0,1,0"/>',
    '<lookat origin="0 0.3 0" target="1 1 2" up="0 1 0"/>',
    '<lookat target="1, 1, 2" origin="0, 0.3, 0"/>',
    '<scale value="0.5"/><rotate y="1" angle="20"/><translate y="0.2"/>',
    "",
)
COLOURS = (
    '<rgb name="reflectance" value="0.2, 0.5, 0.8"/>',
    '<rgb name="reflectance" value="0.2 0.5 0.8"/>',
    '<rgb name="reflectance" value="0.2,0.5,0.8"/>',
    '<rgb name="reflectance" value="0.4"/>',
    '<rgb name="reflectance" value="2e-1, 5E-1, .8"/>',
    '<float name="reflectance" value="0.4"/>',
    '<spectrum name="reflectance" value="0.4"/>',
    '<spectrum name="reflectance" value="400:0.1, 500:0.3, 600:0.8, 700:0.5"/>',
    '<spectrum name="reflectance" value="400:0.1 500:0.3 600:0.8 700:0.5"/>',
    '<spectrum name="reflectance" value="360:.2,830:.2"/>',
    '<spectrum name="reflectance" filename="spectrum.spd"/>',
    '<spectrum type="uniform" name="reflectance"><float name="value" value="0.4"/></spectrum>',
    '<texture type="uniform" name="reflectance"><float name="value" value="0.4"/></texture>',
    '<spectrum type="srgb" name="reflectance"><rgb name="color" value="0.2,0.5,0.8"/></spectrum>',
)
POINTS = (
    '<point name="center" x="0" y="0.3" z="0"/>',
    '<point name="center" value="0,0.3,0"/>',
    '<point name="center" value="0 0.3 0"/>',
    '<point name="center" value="0, 3e-1, -0.0"/>',
    '<vector name="center" value="0,0.3,0"/>',
)
FLAGS = ("true", "false", "True", "FALSE")
RED_ONE = bsdf("diffuse", RED, id="red")
RED_BALL = ball(bsdf("diffuse", RED))


def writing_scenes():
    for i, step in enumerate(STEPS):
        yield f"transform-{i:02d}", scene(shape("cube", place('<scale value="0.7"/>', step), PAINT))
    yield "transform-empty", scene(shape("cube", '<transform name="to_world"/>', PAINT))
    for i, colour in enumerate(COLOURS):
        yield f"colour-{i:02d}", scene(ball(bsdf("diffuse", colour)))
    for i, centre in enumerate(POINTS):
        yield f"point-{i:02d}", scene(shape("sphere", number("radius", "7e-1"), centre, grey(0.7)))
    for i, flag in enumerate(FLAGS):
        yield f"boolean-{i:02d}", scene(shape("rectangle", TURN, value("boolean", "flip_normals", flag)))
    for i, v in enumerate(("0.7", "7e-1", "7E-1", ".7", "+0.7", " 0.7 ")):
        yield f"float-{i:02d}", scene(ball(grey(v)))
    for i, v in enumerate(("8", " 8 ", "-1")):
        yield f"integer-{i:02d}", scene(RED_BALL, integrator=integrator("path", value("integer", "max_depth", v)))
    yield "float-of-integer", scene(shape("sphere", value("integer", "radius", 1), SMALL, grey(0.5)))
    for i, version in enumerate(("3.0.0", "3.5.0", "3.9.1", "2.1.0", "2.0.0")):
        yield f"version-{i:02d}", scene(RED_BALL).replace('"3.0.0"', f'"{version}"')
    yield "xml-declaration", '<?xml version="1.0" encoding="utf-8"?>\n<!-- a comment -->\n' + scene(
        "<!-- another -->", RED_BALL
    )
    yield "scene-robust", scene(boolean("embree_use_robust_intersections"), RED_BALL)
    for kind in ("sphere", "disk", "cylinder", "cube"):
        yield f"lamp-{kind}", scene(
            RED_BALL,
            lights=SKY
            + shape(
                kind,
                place('<scale value="0.4"/>', '<lookat origin="1.5,2,1.5" target="0,0,0" up="0,1,0"/>'),
                area(rgb("radiance", "9,6,3")),
            ),
        )
    yield "ids", scene(shape("sphere", SMALL, grey(0.4), id="a ball"), shape("cube", TURN, grey(0.3), id="box-1"))
    yield "names", scene(shape("sphere", SMALL, bsdf("diffuse", RED, name="any_name", id="paint"), name="thing"))


def reference_scenes():
    ball_of = lambda *content: shape("sphere", SMALL, *content)
    yield "ref-bsdf", scene(RED_ONE, ball_of('<ref id="red"/>'))
    yield "ref-bsdf-named", scene(RED_ONE, ball_of('<ref id="red" name="bsdf"/>'))
    yield "ref-bsdf-nested", scene(RED_ONE, ball_of(bsdf("twosided", '<ref id="red"/>')))
    yield "ref-texture", scene(picture("", id="map"), ball_of(bsdf("diffuse", '<ref id="map" name="reflectance"/>')))
    yield "ref-texture-twice", scene(
        picture("", id="map"),
        ball_of(bsdf("plastic", *(f'<ref name="{n}_reflectance" id="map"/>' for n in ("diffuse", "specular")))),
    )
    yield "ref-spectrum", scene(
        element("spectrum", "uniform", number("value", 0.4), id="tone"),
        ball_of(bsdf("diffuse", '<ref id="tone" name="reflectance"/>')),
    )
    yield "ref-emitter", scene(
        emitter("area", rgb("radiance", "10,9,8"), id="glow"),
        ball_of(grey(0.5)),
        lights=SKY + shape("rectangle", LAMP_PLACE, '<ref id="glow"/>'),
    )
    fog = element("medium", "homogeneous", THICK, id="fog")
    yield "ref-medium", scene(fog, ball(bsdf("null"), '<ref name="interior" id="fog"/>'), integrator=VOLPATH)
    yield "ref-phase", scene(
        element("phase", "hg", id="lobe"),
        ball(bsdf("null"), element("medium", "homogeneous", '<ref id="lobe"/>', name="interior")),
        integrator=VOLPATH,
    )
    yield "ref-volume", scene(
        volume("", file="smoke.vol").replace("<volume ", '<volume id="smoke" '),
        ball(bsdf("null"), element("medium", "heterogeneous", '<ref id="smoke" name="sigma_t"/>', name="interior")),
        integrator=VOLPATH,
    )
    yield "ref-film", scene(
        film().replace("<film ", '<film id="film" '),
        RED_BALL,
        sensor=element("sensor", "perspective", number("fov", 40), LOOK, '<ref id="film"/>'),
    )
    yield "ref-sampler", scene(element("sampler", "independent", id="dice"), RED_BALL, sensor=camera('<ref id="dice"/>'))
    yield "ref-rfilter", scene(
        element("rfilter", "tent", id="tent"), RED_BALL, sensor=camera(film=film('<ref id="tent"/>', rfilter=""))
    )
    yield "ref-later", scene(ball_of('<ref id="red"/>'), RED_ONE)
    yield "ref-nested-id", scene(ball_of(RED_ONE), shape("cube", TURN, '<ref id="red"/>'))
    group = shape(
        "shapegroup",
        shape("cube", place('<scale value="0.3"/>'), grey(0.7)),
        shape("ply", MESH["ply"], place('<scale value="0.3"/>', '<translate x="0.8"/>'), PAINT),
        id="group",
    )
    yield "instance", scene(group, shape("instance", '<ref id="group"/>'))
    yield "instance-moved", scene(
        group, *(shape("instance", place(f'<translate x="{x}" y="0.3"/>'), '<ref id="group"/>') for x in (-1, 0))
    )
    yield "instance-named-ref", scene(group, shape("instance", '<ref name="shapegroup" id="group"/>', SMALL))
    yield "merge", scene(
        RED_ONE,
        shape(
            "merge",
            *(
                shape("ply", MESH["ply"], place('<scale value="0.3"/>', f'<translate x="{x}"/>'), '<ref id="red"/>')
                for x in (-0.5, 0.5)
            ),
        ),
    )
    yield "merge-of-sphere", scene(shape("merge", RED_BALL, shape("cube", TURN)))
    yield "alias", scene(RED_ONE, '<alias id="red" as="paint"/>', ball_of('<ref id="paint"/>'))
    yield "alias-texture", scene(
        picture("", id="map"), '<alias id="map" as="skin"/>', ball_of(bsdf("diffuse", '<ref id="skin" name="reflectance"/>'))
    )
    yield "attribute-of-sphere", scene(
        ball_of(
            texture("vertex_paint", "checkerboard"),
            bsdf("diffuse", texture("reflectance", "mesh_attribute", string("name", "vertex_paint"))),
        )
    )
    yield "emitter-in-medium", scene(
        fog,
        ball(bsdf("null"), '<ref name="interior" id="fog"/>'),
        integrator=VOLPATH,
        lights=emitter("point", point("position", "0,0.3,0"), number("intensity", 3), '<ref name="medium" id="fog"/>'),
    )
    yield "default", scene('<default name="tone" value="0.7"/>', ball_of(grey("$tone")))
    yield "default-in-type", scene(RED_BALL, integrator='<default name="kind" value="path"/>' + integrator("$kind"))
    yield "default-in-text", scene(
        '<default name="base" value="picture"/>', ball_of(bsdf("diffuse", picture("reflectance", file="$base.exr")))
    )
    yield "default-for-boolean", scene(
        '<default name="flip" value="true"/>', shape("rectangle", TURN, value("boolean", "flip_normals", "$flip"))
    )
    yield "default-twice", scene('<default name="tone" value="0.7"/><default name="tone" value="0.2"/>', ball_of(grey("$tone")))
    yield "default-for-size", scene(
        RED_BALL,
        integrator='<default name="width" value="32"/>' + PATH,
        sensor=camera(film=film().replace('name="width" value="32"', 'name="width" value="$width"')),
    )
    yield "path", scene('<path value="textures"/>', ball_of(bsdf("diffuse", picture("reflectance", file="inner.exr"))))
    yield "path-in-name", scene(ball_of(bsdf("diffuse", picture("reflectance", file="textures/inner.exr"))))
    yield "include", scene('<include filename="part.xml"/>')
    yield "include-of-folder", scene('<include filename="textures/part.xml"/>')
    yield "two-sensors", scene(RED_BALL, sensor=camera() + camera(fov=number("fov", 20)))
    yield "two-emitters", scene(
        RED_BALL, lights=parts.LAMP + SKY + emitter("point", point("position", "0,3,0"), number("intensity", 3))
    )
    yield "emitter-with-bsdf", scene(
        RED_BALL, lights=SKY + shape("rectangle", LAMP_PLACE, area(number("radiance", 8)), grey(0.7))
    )
    yield "no-integrator", scene(RED_BALL, integrator="")
    yield "no-sensor", scene(RED_BALL, sensor="")
    yield "no-film", scene(RED_BALL, sensor=element("sensor", "perspective", number("fov", 40), LOOK))
    yield "medium-interface", scene(
        fog,
        ball(
            bsdf("dielectric"),
            '<ref name="interior" id="fog"/>',
            element("medium", "homogeneous", number("sigma_t", 0.01), name="exterior"),
        ),
        integrator=VOLPATH,
        lights=parts.LAMP,
    )
    yield "texture-in-emitter", scene(
        picture("", id="map"), RED_BALL, lights=SKY + shape("rectangle", LAMP_PLACE, area('<ref id="map" name="radiance"/>'))
    )


def main():
    if len(sys.argv) != 2:
        sys.exit(f"usage: {sys.argv[0]} FOLDER")
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    write_files(folder)
    parts.write_scenes(folder, (s for scenes in (plugin_scenes, writing_scenes, reference_scenes) for s in scenes()))


main()
