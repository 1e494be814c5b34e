"""Reads and writes the plainest OpenEXR files: one part, uncompressed scan lines, half-float channels B, G, R.

Written from the public file layout (https://openexr.com/en/latest/OpenEXRFileLayout.html), so that the oracles share
no image code with the program they check.
"""
import struct

MAGIC = 20000630
HALF = 1  # pixel type


def _attribute(name, kind, payload):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(payload)) + payload


def write(path, rgb):
    """rgb[y][x] of three numbers that are exactly representable as halves."""
    height, width = len(rgb), len(rgb[0])

    def channel(row, c):
        values = [float(pixel[c]) for pixel in row]
        packed = struct.pack(f"<{width}e", *values)
        if list(struct.unpack(f"<{width}e", packed)) != values:
            raise ValueError("values do not fit half floats exactly")
        return packed
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", HALF, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    header = struct.pack("<ii", MAGIC, 2)
    header += _attribute("channels", "chlist", channels)
    header += _attribute("compression", "compression", b"\0")
    header += _attribute("dataWindow", "box2i", window)
    header += _attribute("displayWindow", "box2i", window)
    header += _attribute("lineOrder", "lineOrder", b"\0")
    header += _attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += _attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    header += b"\0"
    line_bytes = 3 * width * 2
    first = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * (8 + line_bytes)) for y in range(height))
    lines = b"".join(
        struct.pack("<ii", y, line_bytes) + b"".join(channel(row, c) for c in (2, 1, 0))
        for y, row in enumerate(rgb))
    with open(path, "wb") as out:
        out.write(header + offsets + lines)


def read(path):
    """What write() wrote, as float64 (height, width, 3)."""
    import numpy as np
    data = open(path, "rb").read()
    if struct.unpack_from("<ii", data) != (MAGIC, 2):
        raise ValueError(f"{path}: not a single-part scan-line EXR")
    at, attributes = 8, {}
    while data[at] != 0:
        name_end = data.index(b"\0", at)
        kind_end = data.index(b"\0", name_end + 1)
        size = struct.unpack_from("<i", data, kind_end + 1)[0]
        attributes[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + size]
        at = kind_end + 5 + size
    if attributes["compression"] != b"\0" or len(attributes["channels"]) != 3 * 18 + 1:
        raise ValueError(f"{path}: only uncompressed B, G, R is read here")
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    at += 1 + 8 * height
    image = np.empty((height, width, 3))
    for y in range(height):
        line = np.frombuffer(data, "<f2", 3 * width, at + 8).reshape(3, width)
        image[y] = line[::-1].T
        at += 8 + 6 * width
    return image
