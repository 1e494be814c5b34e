"""Scenes for mitsuba_parameter_scenes.py: ellipsoids of PLY files as surfaces and as radiance fields."""
import math
import random
import struct

from mitsuba_scene_parts import (SKY, bsdf, boolean, element, grey, integer, number, place, scene, shape, string)

TURN = place('<scale value="0.6"/>', '<rotate x="1" angle="15"/>', '<rotate y="1" angle="40"/>', '<translate x="0.2" y="0.4"/>')
UNEVEN = place('<scale x="1.3" y="0.6" z="0.9"/>', '<rotate z="1" angle="30"/>')
MIRROR = bsdf("conductor", string("material", "none"))
ONE_SIDE = bsdf("diffuse")
STEPS = ("Mitsuba 3.9.1 enters some analytic ellipsoids twice, which brightens a dim block by 6 %; ours is the image that "
         "radiance_field.py renders by the definition")
MIRRORED = ("Mitsuba 3.9.1 turns the shells of a to_world that mirrors inside out, so that rays meet their far sides from "
            "inside; ours are those of its `ellipsoids`, which it renders right")


def write_cloud(path, count, degree, seed):
    """Gaussians in a ball of radius 1, as 3D Gaussian splatting writes them. They are large: Mitsuba 3.9.1 enters analytic ones
    whose scales are a hundredth of their distance twice, and does not read big-endian files."""
    draw = random.Random(seed)
    rest = 3 * ((degree + 1) ** 2 - 1)
    names = ["x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", *(f"f_rest_{i}" for i in range(rest)), "opacity",
             "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"]
    rows = []
    for _ in range(count):
        at = [draw.gauss(0, 1) for _ in range(3)]
        far = draw.random() ** (1 / 3) / math.sqrt(sum(v * v for v in at))
        rows.append([*(v * far for v in at), 0, 0, 0, *(draw.gauss(0, 1) for _ in range(3)),
                     *(draw.gauss(0, 0.3) for _ in range(rest)), draw.gauss(0, 2),
                     *(math.log(0.15) + draw.gauss(0, 0.25) for _ in range(3)), *(draw.gauss(0, 1) for _ in range(4))])
    path.write_bytes(("ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % count +
                      "".join(f"property float {n}\n" for n in names) + "end_header\n").encode() +
                     b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows))


def write_attributes(path):
    """Three large ellipsoids with opacities and harmonics under names of their own, as text."""
    names = ["x", "y", "z", "nx", "ny", "nz", "opacities", "sh_coeffs_0", "sh_coeffs_1", "sh_coeffs_2", "weight", "scale_0",
             "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"]
    rows = ("-0.4 0.2 0 0 0 0 0.9 1 0.2 -0.4 7 -1.6 -2.2 -1.8 1 0.2 0 0",
            "0.3 0.4 0.3 0 0 0 0.6 -0.5 0.9 0 7 -1.9 -1.5 -2.3 0.7 0 0.5 0.1",
            "0.1 0 -0.6 0 0 0 0.005 0.3 0.3 1.2 7 -1.4 -1.7 -1.7 0.5 0.5 -0.2 0.3")
    path.write_text("ply\nformat ascii 1.0\nelement vertex 3\n" + "".join(f"property float {n}\n" for n in names) +
                    "end_header\n" + "\n".join(rows) + "\n")


def write_files(folder):
    write_cloud(folder / "cloud.ply", 25, 3, 31)
    write_cloud(folder / "flat_cloud.ply", 20, 0, 32)
    write_attributes(folder / "attributes.ply")


def ellipsoid_cases():
    """(name, scene, why)"""
    cloud, attributes = string("filename", "cloud.ply"), string("filename", "attributes.ply")
    for kind in ("ellipsoids", "ellipsoidsmesh"):
        def case(name, *content, file=attributes, why="", material=ONE_SIDE):
            return f"{kind} {name}".strip(), scene(shape(kind, file, *content, material)), why
        yield case("")
        yield case("of splatting", file=cloud)
        yield case("of degree 0", file=string("filename", "flat_cloud.ply"))
        yield case("to_world", TURN)
        yield case("uneven to_world", UNEVEN)
        yield case("mirrored", place('<scale x="-1"/>'), why=MIRRORED if kind == "ellipsoidsmesh" else "")
        yield case("scale_factor", number("scale_factor", 0.6))
        yield case("extent", number("extent", 1.5))
        yield case("extent_adaptive_clamping", boolean("extent_adaptive_clamping"))
        yield case("as smooth mirror", material=MIRROR)
        yield case("as glass", material=bsdf("dielectric"))
        yield case("without bsdf", material="")
        yield f"{kind} in a group", scene(
            shape("shapegroup", shape(kind, attributes, place('<scale value="0.7"/>'), grey(0.7)), id="group"),
            shape("instance", '<ref id="group"/>', UNEVEN)), ""
    for shell in ("default", "ico_sphere", "box", "uv_sphere"):
        yield f"ellipsoidsmesh shell {shell}", scene(shape("ellipsoidsmesh", attributes, string("shell", shell), grey(0.7))), ""
    yield "ellipsoidsmesh flip_normals", scene(shape("ellipsoidsmesh", attributes, boolean("flip_normals"), ONE_SIDE)), ""


def field(*content, file="cloud.ply", kind="ellipsoids", inside=()):
    return scene(shape(kind, string("filename", file), *inside), integrator=element("integrator", "volprim_rf_basic", *content),
                 lights=SKY)


def field_cases():
    """(name, scene, why)"""
    yield "volprim_rf_basic", field(), STEPS
    yield "volprim_rf_basic max_depth 2", field(integer("max_depth", 2)), STEPS
    yield "volprim_rf_basic max_depth -1", field(integer("max_depth", -1)), ""
    yield "volprim_rf_basic srgb_primitives", field(boolean("srgb_primitives", False)), ""
    yield "volprim_rf_basic of shells", field(kind="ellipsoidsmesh"), ""
    yield "volprim_rf_basic adaptive", field(inside=(boolean("extent_adaptive_clamping"),)), ""
    yield "volprim_rf_basic adaptive shells", field(kind="ellipsoidsmesh", inside=(boolean("extent_adaptive_clamping"),)), ""
    yield "volprim_rf_basic to_world", field(kind="ellipsoidsmesh", inside=(TURN,)), ""
    yield "volprim_rf_basic of degree 0", field(file="flat_cloud.ply"), ""
    yield "volprim_rf_basic of attributes", field(file="attributes.ply"), ""
