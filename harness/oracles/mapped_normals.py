#!/usr/bin/env python3
"""What a Lambertian square of albedo 0.8 under a normal map or a bump map reflects, after Mitsuba 3's documentation of
`normalmap` and `bumpmap`, Schuessler et al. 2017 (section 3: normals that are turned away are mirrored) and Estevez,
Lecocq and Stein 2019 (eqs. 2 and 3). Prints the table of renderer/scene/mapped_normals_test.cpp: f cos for directions to the
camera o and to the light i, both scaled to length 1 from what is printed.

The square spans -1..1 in x and y at z = 0, u and v go along x and y, so that dp/du = (2, 0, 0), dp/dv = (0, 2, 0).
The height is 0.4 u + v; the normal map's red and green are 0.75 and 0.35, its blue 0.8.
"""
import math

ALBEDO = 0.8


def unit(v):
    n = math.sqrt(sum(a * a for a in v))
    return [a / n for a in v]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def from_map(red, green, blue):
    return [2 * red - 1, 2 * green - 1, 2 * blue - 1]


def from_heights(du, dv, scale):
    # The displaced square is z = scale h(x, y), whose upward normal is (-dz/dx, -dz/dy, 1); u = (x + 1) / 2.
    return [-scale * du / 2, -scale * dv / 2, 1]


def reflected(n, o, i, flips, shadows):
    o, i, n = unit(o), unit(i), unit(n)
    if flips and o[2] * dot(o, n) <= 0:
        n = [-n[0], -n[1], n[2]]
    if dot(o, n) <= 0 or dot(i, n) <= 0 or i[2] * dot(i, n) <= 0:
        return 0
    value = ALBEDO / math.pi * dot(i, n)
    if shadows:
        tilt = math.acos(n[2])
        alpha2 = min(math.tan(tilt) ** 2 / 8, 1)
        value *= 2 / (1 + math.sqrt(1 + alpha2 * math.tan(math.acos(i[2])) ** 2))
    return value


PAIRS = [
    ((0, 0, 1), (0, 0, 1)),
    ((0.3, 0.1, 1), (0.5, 0.2, 0.7)),
    ((0.3, 0.1, 1), (-0.5, 0.2, 0.7)),
    ((0.3, 0.1, 1), (0.5, -0.9, 0.4)),
    ((-2, 0.5, 0.4), (0.4, 0.3, 0.6)),
    ((-2, 0.5, 0.4), (-0.9, 0.3, 0.3)),
    ((1.5, 1.8, 0.3), (0.9, -0.3, 0.3)),
    ((1.5, 1.8, 0.3), (-0.6, -0.2, 0.5)),
]

if __name__ == "__main__":
    for name, n in (("normal_map", from_map(0.75, 0.35, 0.8)), ("bump_map", from_heights(0.4, 1, 1.5))):
        for flips in (False, True):
            for shadows in (False, True):
                for o, i in PAIRS:
                    value = reflected(n, o, i, flips, shadows)
                    flags = f"{str(flips).lower()}, {str(shadows).lower()}"
                    ends = ", ".join("{%s, %s, %s}" % tuple(f"{float(c)}f" for c in end) for end in (o, i))
                    print(f"{{Map::{name}, {flags}, {ends}, {value:.7g}}},")
