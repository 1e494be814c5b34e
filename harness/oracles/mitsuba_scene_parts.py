"""Parts of the scenes of mitsuba_parameter_scenes.py: elements as text, a floor, a lamp, a sky, and the files they name."""
import math
import random
import struct
import zlib

import exr_file


def element(tag, kind, *content, name="", id=""):
    """<tag type="kind">content</tag>"""
    extra = (f' name="{name}"' if name else "") + (f' id="{id}"' if id else "")
    return f'<{tag} type="{kind}"{extra}>' + "".join(content) + f"</{tag}>"


def value(tag, name, v):
    return f'<{tag} name="{name}" value="{v}"/>'


def number(name, v):
    return value("float", name, v)


def numbers(**values):
    return "".join(number(name, v) for name, v in values.items())


def integer(name, v):
    return value("integer", name, v)


def boolean(name, v=True):
    return value("boolean", name, "true" if v else "false")


def string(name, v):
    return value("string", name, v)


def rgb(name, v):
    return value("rgb", name, v)


def point(name, v):
    return value("point", name, v)


def vector(name, v):
    return value("vector", name, v)


def spectrum(name, v):
    return value("spectrum", name, v)


def place(*steps, name="to_world"):
    return f'<transform name="{name}">' + "".join(steps) + "</transform>"


def bsdf(kind, *content, **attributes):
    return element("bsdf", kind, *content, **attributes)


def shape(kind, *content, **attributes):
    return element("shape", kind, *content, **attributes)


def emitter(kind, *content, **attributes):
    return element("emitter", kind, *content, **attributes)


def texture(name, kind, *content, **attributes):
    return element("texture", kind, *content, name=name, **attributes)


def picture(name, *content, file="picture.exr", **attributes):
    return texture(name, "bitmap", string("filename", file), *content, **attributes)


def grey(v):
    return bsdf("diffuse", number("reflectance", v))


def integrator(kind, *content, name=""):
    return element("integrator", kind, *content, name=name)


def area(*content):
    return emitter("area", *content)


CHECKS = texture("reflectance", "checkerboard", rgb("color0", "0.7,0.6,0.5"), rgb("color1", "0.2,0.3,0.4"),
                 place('<scale x="6" y="6"/>', name="to_uv"))
FLOOR = shape("rectangle", place('<scale value="3"/>', '<rotate x="1" angle="-90"/>', '<translate y="-0.5"/>'),
              bsdf("diffuse", CHECKS))
LAMP_PLACE = place('<scale value="0.7"/>', '<lookat origin="2,3,2" target="0,0,0" up="0,1,0"/>')
LAMP = shape("rectangle", LAMP_PLACE, area(rgb("radiance", "10,9,8")))
SKY = emitter("constant", rgb("radiance", "0.3,0.4,0.5"))
BOX = element("rfilter", "box")
LOOK = place('<lookat origin="0.5,1.2,5" target="0,0.3,0" up="0,1,0"/>')
PATH = element("integrator", "path", integer("max_depth", 8))
VOLPATH = element("integrator", "volpath", integer("max_depth", 8))


def ball(*content):
    return shape("sphere", number("radius", 0.7), point("center", "0,0.3,0"), *content)


def film(*content, rfilter=BOX, width=64, height=48):
    return element("film", "hdrfilm", integer("width", width), integer("height", height), rfilter, *content)


def camera(*content, kind="perspective", fov=number("fov", 40), to_world=LOOK, film=film(), sampler=None):
    sampler = element("sampler", "independent", integer("sample_count", 16)) if sampler is None else sampler
    return element("sensor", kind, fov, to_world, *content, film, sampler)


def scene(*content, integrator=PATH, sensor=camera(), floor=FLOOR, lights=LAMP + SKY):
    return '<scene version="3.0.0">' + integrator + sensor + floor + "".join(content) + lights + "</scene>\n"


# ---- files that scenes name -------------------------------------------------------------------------------------------------

def half(rows):
    return [[struct.unpack("<3e", struct.pack("<3e", *pixel)) for pixel in row] for row in rows]


def write_png(path, pixels):
    """pixels[y][x] of three numbers from 0 to 1, in 8 bits."""
    write_png_lines(path, len(pixels[0]), 8, 2, [bytes(int(v * 255) for pixel in row for v in pixel) for row in pixels])


def write_png_lines(path, width, bits, kind, lines):
    """kind: 0 grey, 2 RGB, 6 RGBA."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(lines), bits, kind, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(b"".join(b"\0" + line for line in lines))) + chunk(b"IEND", b""))


def write_ply(path, points, faces, normals=None, uv=None, of_vertices=None, of_faces=None):
    """The last two: names of properties, which may have a type before them, and a function that draws a row of values."""
    def declared(names):
        return [f"property {name}" if " " in name else f"property float {name}" for name in names]

    columns = ["x", "y", "z"] + (["nx", "ny", "nz"] if normals else []) + (["u", "v"] if uv else [])
    vertex_names, vertex_values = of_vertices or ((), tuple)
    face_names, face_values = of_faces or ((), tuple)
    head = ["ply", "format ascii 1.0", f"element vertex {len(points)}", *declared([*columns, *vertex_names]),
            f"element face {len(faces)}", "property list uchar int vertex_indices", *declared(face_names), "end_header"]
    rows = [" ".join(f"{v:.6g}" for v in (*p, *(normals[i] if normals else ()), *(uv[i] if uv else ()), *vertex_values()))
            for i, p in enumerate(points)]
    path.write_text("\n".join(head + rows + [" ".join(f"{v:.6g}" for v in (3, *f, *face_values())) for f in faces]) + "\n")


def write_obj(path, points, faces, normals=None, uv=None):
    text = "".join(f"v {p[0]:.6g} {p[1]:.6g} {p[2]:.6g}\n" for p in points)
    text += "".join(f"vt {t[0]:.6g} {t[1]:.6g}\n" for t in uv or ())
    text += "".join(f"vn {n[0]:.6g} {n[1]:.6g} {n[2]:.6g}\n" for n in normals or ())
    corner = "{0}/{0}/{0}" if normals else "{0}"
    text += "".join("f " + " ".join(corner.format(i + 1) for i in f) + "\n" for f in faces)
    path.write_text(text)


def write_serialized(path, meshes):
    """Mitsuba 0.6's compressed meshes, version 4: (points, faces, normals, uv) each, and the list of their offsets."""
    def packed(points, faces, normals, uv):
        raw = struct.pack("<I", 0x1003) + b"mesh\0" + struct.pack("<QQ", len(points), len(faces))
        for kind, rows in (("f", points), ("f", normals), ("f", uv), ("I", faces)):
            flat = [v for row in rows for v in row]
            raw += struct.pack(f"<{len(flat)}{kind}", *flat)
        return struct.pack("<HH", 0x041C, 4) + zlib.compress(raw)
    parts = [packed(*mesh) for mesh in meshes]
    offsets = [sum(map(len, parts[:i])) for i in range(len(parts))]
    path.write_bytes(b"".join(parts) + struct.pack(f"<{len(parts)}QI", *offsets, len(parts)))


def write_vol(path, values):
    """values[z][y][x][channel] in the box from (-0.7, -0.4, -0.7) to (0.7, 1, 0.7), that of `ball`."""
    depth, height, width, channels = len(values), len(values[0]), len(values[0][0]), len(values[0][0][0])
    flat = [v for slice in values for row in slice for cell in row for v in cell]
    path.write_bytes(b"VOL\x03" + struct.pack("<5i6f", 1, width, height, depth, channels, -0.7, -0.4, -0.7, 0.7, 1, 0.7) +
                     struct.pack(f"<{len(flat)}f", *flat))


def write_curves(path, curves):
    """Lists of (x, y, z, radius)."""
    path.write_text("\n\n".join("\n".join(" ".join(f"{v:.6g}" for v in point) for point in curve) for curve in curves) + "\n")


def tuft(draw, points, count=60):
    """Curves that rise from a disc and lean, some as thick as a finger and some thin, some pointed."""
    curves = []
    for i in range(count):
        a, r = 2 * math.pi * draw.random(), 0.7 * math.sqrt(draw.random())
        lean, turn = 0.5 * draw.random(), 2 * math.pi * draw.random()
        thick = (0.12, 0.04, 0.015)[i % 3]
        curve = []
        for k in range(points):
            t = k / (points - 1)
            curve.append((r * math.cos(a) + lean * t * t * math.cos(turn + 2 * t), 1.5 * t - 0.5,
                          r * math.sin(a) + lean * t * t * math.sin(turn + 2 * t), thick * (1 - t if i % 2 else 1)))
        curves.append(curve)
    return curves


def dented_ball(size):
    """Distances that are not exact ones, over the unit cube."""
    def value(x, y, z):
        p = [x - 0.5, y - 0.5, z - 0.5]
        return math.sqrt(sum(v * v for v in p)) - 0.35 + 0.05 * math.sin(9 * x) * math.cos(8 * y + 4 * z)
    along = [[i / (n - 1) for i in range(n)] for n in size]
    return [[[[value(x, y, z)] for x in along[0]] for y in along[1]] for z in along[2]]


def coarse_egg(columns=10, rows=6):
    """A closed body of few triangles with a seam in u, so that facets and uv show."""
    points, normals, uv, faces = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            t, p = math.pi * j / rows, 2 * math.pi * i / columns
            n = (math.sin(t) * math.cos(p), math.cos(t), math.sin(t) * math.sin(p))
            points.append((n[0], 1.2 * n[1], n[2]))
            normals.append(n)
            uv.append((i / columns, j / rows))
    for j in range(rows):
        for i in range(columns):
            a, b = j * (columns + 1) + i, (j + 1) * (columns + 1) + i
            faces += [(a, a + 1, b + 1)] if j > 0 else []
            faces += [(a, b + 1, b)] if j < rows - 1 else []
    return points, faces, normals, uv


def write_files(folder):
    draw = random.Random(7)
    colours = half([[[0.05 + 0.9 * draw.random() for _ in range(3)] for _ in range(6)] for _ in range(5)])
    exr_file.write(folder / "picture.exr", colours)
    write_png(folder / "picture.png", colours)
    exr_file.write(folder / "bumps.exr", half([[[draw.random()] * 3 for _ in range(8)] for _ in range(8)]))
    leaning = [[(0.5 + 0.2 * (2 * draw.random() - 1), 0.5 + 0.2 * (2 * draw.random() - 1), 0.95) for _ in range(8)]
               for _ in range(8)]
    exr_file.write(folder / "normals.exr", half(leaning))
    light = [[[0.2 + draw.random() + (6 if (x, y) == (4, 2) else 0) for _ in range(3)] for x in range(16)] for y in range(8)]
    exr_file.write(folder / "sky.exr", half(light))
    for name, channels in (("smoke", 1), ("coloured", 3)):
        write_vol(folder / f"{name}.vol", [[[[draw.random() for _ in range(channels)] for _ in range(4)] for _ in range(3)]
                                           for _ in range(5)])
    write_vol(folder / "dented.vol", dented_ball((12, 12, 12)))
    write_vol(folder / "uneven.vol", dented_ball((12, 9, 14)))
    write_vol(folder / "slope.vol", [[[[0.3 + 0.4 * x - y + 0.1 * z] for x in (0, 0.5, 1)] for y in (0, 0.5, 1)]
                                     for z in (0, 0.5, 1)])
    write_curves(folder / "tuft.txt", tuft(random.Random(11), 7))
    write_curves(folder / "sticks.txt", tuft(random.Random(12), 4, 30))
    (folder / "spectrum.spd").write_text("# wavelength, value\n400 0.2\n480 0.3\n560 0.9\n640 0.6\n720 0.4\n")
    points, faces, normals, uv = coarse_egg()
    write_ply(folder / "mesh.ply", points, faces, normals, uv)
    write_obj(folder / "mesh.obj", points, faces, normals, uv)
    write_serialized(folder / "two.serialized", [([(0.5 * x, 0.5 * y, 0.5 * z) for x, y, z in points], faces, normals, uv),
                                                 (points, faces, normals, uv)])
    write_ply(folder / "bare.ply", points, faces)
    write_obj(folder / "bare.obj", points, faces)
    write_ply(folder / "painted.ply", points, faces, normals, uv,
              (("r", "g", "b", "tint_r", "tint_g", "tint_b", "heat_0", "uchar grey_0"),
               lambda: [*(draw.random() for _ in range(7)), draw.randrange(256)]),
              (("part_x", "part_y", "part_z", "dust_1"), lambda: [draw.random() for _ in range(4)]))
    (folder / "part.xml").write_text('<scene version="3.0.0">' + ball(bsdf("diffuse", rgb("reflectance", "0.2,0.8,0.1"))) +
                                     "</scene>\n")


def write_scenes(folder, scenes):
    """(name, text) each, a file each; prints their number."""
    written = 0
    for name, text in scenes:
        (folder / f"{name}.xml").write_text(text)
        written += 1
    print(f"{folder}: {written} scenes")
