"""Scenes where Mitsuba 3.9.1 departs from its documents or from a closed form, one departure each.

Each has the closed form of its mean green. Our image must be that, and our image with --as-mitsuba must be Mitsuba's.
The table of docs/formats/scene.md, where Mitsuba departs, has a row for each.
"""
import math
from pathlib import Path

from mitsuba_scene_parts import (area, boolean, bsdf, element, emitter, grey, integer, number, place, rgb, shape, string,
                                 texture)

WHITE = emitter("constant", number("radiance", 1))
FACING = place('<lookat origin="0,0,5" target="0,0,0" up="0,1,0"/>')


def view(*content, half=1.0, width=64, height=64, rfilter="box", radius=""):
    """An orthographic camera at +z that sees the square from -half to half of the plane z = 0."""
    where = place(f'<scale x="{half}" y="{half}"/>', '<lookat origin="0,0,5" target="0,0,0" up="0,1,0"/>')
    film = element("film", "hdrfilm", integer("width", width), integer("height", height), element("rfilter", rfilter, radius))
    return element("sensor", "orthographic", where, film, element("sampler", "independent", integer("sample_count", 16)), *content)


def scene(*content, integrator=element("integrator", "path"), sensor=view()):
    return '<scene version="3.0.0">' + integrator + sensor + "".join(content) + "</scene>\n"


def wall(*content, size=4):
    """A square that faces the camera, larger than the view unless `size` is small."""
    return shape("rectangle", place(f'<scale value="{size}"/>'), *content)


def square_irradiance(half, height):
    """Of a square lamp of radiance 1 on a point below its middle, which faces it: 4 corners of Howell's factor times pi."""
    a = half / height
    return 4 * a / math.sqrt(1 + a * a) * math.atan(a / math.sqrt(1 + a * a))


def write_files(folder):
    """A square of two triangles that faces +z, flat, and one whose normals lean by 60 degrees."""
    corners, faces = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2), (0, 2, 3)]
    for name, normal in (("flat", None), ("leaning", (math.sin(math.pi / 3), 0, 0.5))):
        columns = "property float nx\nproperty float ny\nproperty float nz\n" if normal else ""
        rows = "".join(" ".join(map(str, (*c, *(normal or ())))) + "\n" for c in corners)
        (Path(folder) / f"{name}.ply").write_text(
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + columns +
            "element face 2\nproperty list uchar int vertex_indices\nend_header\n" + rows +
            "".join("3 " + " ".join(map(str, f)) + "\n" for f in faces))


def departures():
    """(name, scene, closed form of the mean, its derivation)"""
    one_square = place('<scale value="0.4"/>', name="to_uv")
    board = texture("weight", "checkerboard", number("color0", 0.25), number("color1", 0.75), one_square)
    yield ("checkerboard as a number", scene(wall(bsdf("blendbsdf", board, grey(0.2), grey(0.8))), WHITE),
           0.2 * 0.75 + 0.8 * 0.25, "all uv lie in color0's square: weight 0.25 of 0.8 and 0.75 of 0.2, before a sky of 1")
    yield ("rotate about 2 y", scene(shape("rectangle", place('<scale value="0.25"/>', '<rotate y="2" angle="60"/>'), area(
        number("radiance", 1)))), 0.25 * 0.25 * 0.5, "a lamp of 1 on a 16th of the view, turned by 60 degrees: cos 60 is 0.5")
    for kind, content, value in (("directional", '<vector name="direction" value="0,0,-1"/>' + number("irradiance", 2), 2),
                                 ("point", '<point name="position" value="0,0,3"/>' + number("intensity", 18), 2),
                                 ("spot", FACING + number("intensity", 50) + number("cutoff_angle", 40), 2),
                                 ("projector", FACING + number("scale", 50 / math.pi) + number("fov", 60), 2)):
        integrator = element("integrator", "direct", integer("emitter_samples", 4), integer("bsdf_samples", 1))
        yield (f"direct, 4 samples of a {kind}", scene(wall(grey(0.5)), emitter(kind, content), integrator=integrator,
                                                     sensor=view(half=0.02)),
               0.5 / math.pi * value, "albedo / pi times an irradiance of 2")
    no_bsdf = element("integrator", "direct", integer("emitter_samples", 1), integer("bsdf_samples", 0))
    yield ("direct, a mirror without samples of directions",
           scene(wall(bsdf("conductor", string("material", "none"))), WHITE, integrator=no_bsdf), 1, "a mirror before a sky of 1")
    mirror = bsdf("conductor", string("material", "none"))
    yield ("blendbsdf of a mirror", scene(wall(bsdf("blendbsdf", number("weight", 0.8), grey(0.5), mirror)), WHITE),
           0.8 + 0.2 * 0.5, "0.8 of a mirror and 0.2 of albedo 0.5 before a sky of 1")
    glass = bsdf("dielectric", number("int_ior", 1.5), number("ext_ior", 1))
    yield ("blendbsdf of glass", scene(wall(bsdf("blendbsdf", number("weight", 0.3), glass, grey(0.5))), WHITE),
           0.7 * (0.04 + 0.96 / 1.5**2) + 0.3 * 0.5, "0.7 of glass, whose radiance from within is 1 / 1.5^2 of the sky's 1, and 0.3 "
           "of albedo 0.5")
    lamp = place('<scale value="0.3"/>', '<rotate x="1" angle="180"/>', '<translate z="2"/>')
    direct = element("integrator", "path", integer("max_depth", 2))
    yield ("mesh that emits by leaning normals", scene(
        wall(grey(0.5)), shape("ply", string("filename", "leaning.ply"), lamp, bsdf("diffuse", number("reflectance", 0)), area(
            number("radiance", 10))), integrator=direct, sensor=view(half=0.02).replace("0,0,5", "0,0,1.9")),
           10 * 0.5 / math.pi * square_irradiance(0.3, 2), "albedo / pi times the irradiance of a square lamp (Howell), which its "
           "normals do not change")
    yield ("mirrored mesh without normals", scene(shape("ply", string("filename", "flat.ply"), place(
        '<scale x="-4" y="4"/>'), grey(0.5)), WHITE), 0.5, "albedo 0.5 before a sky of 1, on the front that the file has")
    n = 2.4
    fresnel = ((n - 1) / (n + 1))**2
    yield ("plastic of index 2.4", scene(wall(bsdf("plastic", number("int_ior", n), number("ext_ior", 1))), WHITE),
           fresnel + (1 - fresnel) * 0.5, "what enters and is not absorbed comes out: F + (1 - F) albedo before a sky of 1")
    tent = view(width=16, height=12, rfilter="tent", radius=number("radius", 0.5))
    lit = place('<translate x="1"/>', f'<translate x="{0.1375 / 8}"/>')
    edge = 1 - 0.5 * (0.1375 / 0.5)**2
    yield ("tent of half a pixel", scene(shape("rectangle", lit, area(number("radiance", 1))), sensor=tent), (7 + edge) / 16,
           "of 16 columns 7 see a lamp of 1, and one does but for the first 0.1375: the integral of the tent there")
