"""The files that the scenes of new_scenes.py name."""

import struct

import mitsuba_scene_parts as parts


def write_binary_ply(path, order, points, faces, normals, uv):
    head = (
        "ply\nformat binary_{}_endian 1.0\nelement vertex {}\n{}element face {}\nproperty list uchar int vertex_indices\n"
        "end_header\n".format(
            "little" if order == "<" else "big",
            len(points),
            "".join(f"property float {n}\n" for n in ("x", "y", "z", "nx", "ny", "nz", "u", "v")),
            len(faces),
        )
    )
    path.write_bytes(
        head.encode()
        + b"".join(struct.pack(order + "8f", *p, *n, *t) for p, n, t in zip(points, normals, uv))
        + b"".join(struct.pack(order + "B3i", 3, *f) for f in faces)
    )


def write_files(folder):
    parts.write_files(folder)
    points, faces, normals, uv = parts.coarse_egg()
    for name, order in (("little", "<"), ("big", ">")):
        write_binary_ply(folder / f"{name}.ply", order, points, faces, normals, uv)
    text = (folder / "mesh.ply").read_text()
    (folder / "indices.ply").write_text(
        text.replace("vertex_indices", "vertex_index")
        .replace("property float u\n", "property float s\n")
        .replace("property float v\n", "property float t\n")
        .replace("ply\n", "ply\ncomment egg\n", 1)
    )
    egg = (folder / "mesh.obj").read_text()
    (folder / "forms.obj").write_text("# egg\nmtllib none.mtl\no egg\ng part\nusemtl none\ns 1\n" + egg)
    (folder / "curves.txt").write_text(
        "\n\n".join(
            "\n".join(f"{x + 0.1 * (k % 2):.6g} {0.35 * k - 0.5:.6g} {0.1 * k:.6g} 0.08" for k in range(6))
            for x in (-0.6, 0, 0.6)
        )
        + "\n"
    )
    (folder / "quads.obj").write_text(
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
    )
    (folder / "normals.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n")
    write_pictures(folder)
    size = 8
    at = [i / (size - 1) - 0.5 for i in range(size)]
    write_unit_vol(folder / "ball.vol", [[[((x * x + y * y + z * z) ** 0.5 - 0.4,) for x in at] for y in at] for z in at])
    write_unit_vol(folder / "flakes.vol", [[[(0.2, 1, 0.6, 0, 0, 0)] * 2] * 2] * 2)
    splats = [
        (*place, 0, 0, 1, *colour, *size, *turn)
        for place, colour, size, turn in (
            ((-0.5, 0, 0), (0.5, 0.1, 0.2, 1), (-2.2, -1.6, -2.0), (1, 0, 0, 0)),
            ((0.4, 0.3, 0.2), (0.1, 0.8, 0.2, 2), (-1.7, -2.4, -2.0), (0.9, 0.3, 0, 0.1)),
            ((0, 0.6, -0.3), (0.2, 0.1, 0.9, 0), (-2.1, -2.1, -1.8), (0.8, 0, 0.5, 0)),
        )
    ]
    names = (
        "x",
        "y",
        "z",
        "nx",
        "ny",
        "nz",
        "f_dc_0",
        "f_dc_1",
        "f_dc_2",
        "opacity",
        "scale_0",
        "scale_1",
        "scale_2",
        "rot_0",
        "rot_1",
        "rot_2",
        "rot_3",
    )
    (folder / "splats.ply").write_bytes(
        (
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
            + "".join(f"property float {n}\n" for n in names)
            + "end_header\n"
        ).encode()
        + b"".join(struct.pack("<17f", *s) for s in splats)
    )
    (folder / "textures").mkdir(exist_ok=True)
    (folder / "textures" / "inner.exr").write_bytes((folder / "picture.exr").read_bytes())
    (folder / "textures" / "part.xml").write_text((folder / "part.xml").read_text())


def write_pictures(folder):
    """One picture in the formats of images that Mitsuba reads. It has 5 columns and 4 rows."""
    width, height = 5, 4
    rows = [[(40 + 40 * x, 200 - 30 * y, 60 + 25 * (x + y) % 150) for x in range(width)] for y in range(height)]
    linear = [[tuple(v / 255 for v in pixel) for pixel in row] for row in rows]
    flat = [bytes(v for pixel in row for v in pixel) for row in rows]
    turned = [bytes(v for pixel in row for v in reversed(pixel)) for row in rows]
    (folder / "picture.ppm").write_bytes(f"P6\n{width} {height}\n255\n".encode() + b"".join(flat))
    (folder / "picture.pfm").write_bytes(
        f"PF\n{width} {height}\n-1.0\n".encode()
        + b"".join(struct.pack("<3f", *pixel) for row in reversed(linear) for pixel in row)
    )
    (folder / "picture.tga").write_bytes(
        struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, width, height, 24, 0x20)
        + b"".join(turned)
        + bytes(8)
        + b"TRUEVISION-XFILE.\0"
    )
    lines = b"".join(row + b"\0" * (-len(row) % 4) for row in reversed(turned))
    (folder / "picture.bmp").write_bytes(
        struct.pack("<2sIHHI", b"BM", 54 + len(lines), 0, 0, 54)
        + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, len(lines), 2835, 2835, 0, 0)
        + lines
    )
    (folder / "picture.hdr").write_bytes(
        f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode()
        + b"".join(bytes((*(min(255, int(v * 256)) for v in pixel), 128)) for row in linear for pixel in row)
    )
    parts.write_png_lines(
        folder / "deep.png", width, 16, 2, [struct.pack(f">{3 * width}H", *(v * 257 for v in row)) for row in flat]
    )
    parts.write_png_lines(folder / "grey.png", width, 8, 0, [row[:width] for row in flat])
    parts.write_png_lines(folder / "clear.png", width, 8, 6, [bytes(v for pixel in row for v in (*pixel, 128)) for row in rows])


def write_unit_vol(path, values):
    depth, height, width, channels = len(values), len(values[0]), len(values[0][0]), len(values[0][0][0])
    flat = [v for plane in values for row in plane for cell in row for v in cell]
    path.write_bytes(
        b"VOL\x03"
        + struct.pack("<5i6f", 1, width, height, depth, channels, 0, 0, 0, 1, 1, 1)
        + struct.pack(f"<{len(flat)}f", *flat)
    )
