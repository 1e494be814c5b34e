"""The sky of Hosek and Wilkie 2012: writes the renderer's table of coefficients, and prints what its tests expect.

    apt-get source --download-only blender     (Debian 12, source lines of apt enabled)
    tar xJf blender_3.4.1+dfsg.orig.tar.xz --wildcards '*/intern/sky/source/sky_model_data.h'
    python3 harness/oracles/sky_oracle.py table HEADER > scenes/sky/sky_hosek_wilkie_table.cpp
    python3 harness/oracles/sky_oracle.py expected HEADER

HEADER is the authors' own file of data for the XYZ version of their model, 1.4a (BSD-3-Clause), which Blender carries
unchanged and Debian packages. Expected values are worked out from that header, not from the renderer's table, by the
paper's formulas: Bernstein's polynomials by de Casteljau's algorithm, where the C++ sums their terms, and colours
by a matrix that is inverted from the primaries of Rec. 709, where the C++ has a rounded one. Python's own library only.
"""
import math
import re
import sys

ALBEDOS, TURBIDITIES, POINTS, PARAMETERS = 2, 10, 6, 9
Y_INTEGRAL = 106.7502593994140625  # Mitsuba's integral of the CIE 1931 y function, nm

LICENCE = """\
// Coefficients of the sky model of Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", for
// CIE XYZ, version 1.4a of the authors' data, as intern/sky/source/sky_model_data.h of Blender 3.4.1 has them (Debian
// source package blender). Written by harness/oracles/sky_oracle.py. The data's licence:
//
// Copyright 2012-2013 Lukas Hosek and Alexander Wilkie. All rights reserved.
//
// Redistribution and use in source and binary forms, with or without modification, are permitted provided that the
// following conditions are met:
//   * Redistributions of source code must retain the above copyright notice, this list of conditions and the following
//     disclaimer.
//   * Redistributions in binary form must reproduce the above copyright notice, this list of conditions and the
//     following disclaimer in the documentation and/or other materials provided with the distribution.
//   * None of the names of the contributors may be used to endorse or promote products derived from this software
//     without specific prior written permission.
// THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS" AND ANY EXPRESS OR IMPLIED WARRANTIES,
// INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE
// DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDERS OR CONTRIBUTORS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL,
// SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR
// SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY,
// WHETHER IN CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE
// OF THIS SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE.
#include "scenes/sky/sky_hosek_wilkie.h"

namespace photonproof {
// clang-format off
"""


def arrays(path):
    """Six lists of numbers by name."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", open(path, encoding="utf-8").read(), flags=re.S)
    found = re.findall(r"double (dataset\w+)\[\] = \{([^}]*)\}", text)
    return {name: [float(word) for word in body.replace(",", " ").split()] for name, body in found}


def rows(numbers, width):
    for i in range(0, len(numbers), width):
        print("    " + ", ".join(f"{x:.7g}" for x in numbers[i:i + width]) + ",")


def write_table(data):
    print(LICENCE)
    print("const std::array<HosekWilkieTable, 3> hosek_wilkie_tables{{")
    for channel in "123":
        print("  {{")
        rows(data["datasetXYZ" + channel], PARAMETERS)
        print("  }, {")
        rows(data["datasetXYZRad" + channel], POINTS)
        print("  }},")
    print("}};\n")
    print("// clang-format on\n}  // namespace photonproof")


def casteljau(points, t):
    while len(points) > 1:
        points = [a + (b - a) * t for a, b in zip(points, points[1:])]
    return points[0]


def coefficient(numbers, per_point, which, turbidity, albedo, elevation):
    """Between two turbidities and two albedos, along the elevation by a curve of the fifth degree."""
    t = (elevation / (math.pi / 2))**(1 / 3)
    low = min(int(turbidity), 9)
    total = 0
    for a, of_albedo in ((0, 1 - albedo), (1, albedo)):
        for step, of_turbidity in ((low, low + 1 - turbidity), (low + 1, turbidity - low)):
            first = (a * TURBIDITIES + step - 1) * POINTS * per_point
            points = [numbers[first + i * per_point + which] for i in range(POINTS)]
            total += of_albedo * of_turbidity * casteljau(points, t)
    return total


def inverse(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return [[x / det for x in row] for row in ((e * i - f * h, c * h - b * i, b * f - c * e),
                                               (f * g - d * i, a * i - c * g, c * d - a * f),
                                               (d * h - e * g, b * g - a * h, a * e - b * d))]


def times(m, v):
    return [sum(x * y for x, y in zip(row, v)) for row in m]


def rgb_to_xyz():
    """From the chromaticities of Rec. 709's primaries; the white is that of the matrices of Poynton, Mitsuba and many
    others, which differs from 0.3127, 0.3290 by 3e-4."""
    columns = [(x / y, 1, (1 - x - y) / y) for x, y in ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))]
    white = (0.950456, 1, 1.088754)
    primaries = [[column[i] for column in columns] for i in range(3)]
    scale = times(inverse(primaries), white)
    return [[x * s for x, s in zip(row, scale)] for row in primaries]


TO_XYZ = rgb_to_xyz()
TO_RGB = inverse(TO_XYZ)


def channel_radiance(data, channel, turbidity, albedo, elevation, theta, gamma):
    """W m^-2 sr^-1, weighted with the CIE's function 1, 2 or 3: x, y or z."""
    key = (channel, turbidity, albedo, elevation)
    if key not in COEFFICIENTS:
        shape, mean = data[f"datasetXYZ{channel}"], data[f"datasetXYZRad{channel}"]
        COEFFICIENTS[key] = [coefficient(shape, PARAMETERS, k, *key[1:]) for k in range(PARAMETERS)]
        COEFFICIENTS[key].append(coefficient(mean, 1, 0, *key[1:]))
    a, b, c, d, e, f, g, i, h, mean = COEFFICIENTS[key]
    # The paper's equation 8; its chi, equation 9. The data have I before H.
    chi = (1 + math.cos(gamma)**2) / (1 + h * h - 2 * h * math.cos(gamma))**1.5
    return mean * (1 + a * math.exp(b / (math.cos(theta) + 0.01))) * (
        c + d * math.exp(e * gamma) + f * math.cos(gamma)**2 + g * chi + i * math.sqrt(math.cos(theta)))


COEFFICIENTS = {}


def rgb(data, turbidity, albedo_rgb, *view):
    """A component's ground is as bright as that component's albedo."""
    return [times(TO_RGB, [channel_radiance(data, channel, turbidity, albedo, *view) for channel in (1, 2, 3)])[i]
            for i, albedo in enumerate(albedo_rgb)]


# Turbidity, albedo, the sun's height above the horizon, the view's angle from the zenith and its azimuth from the sun's.
LOOKS = [(3, (0.3, 0.3, 0.3), 45, 0, 0), (3, (0.3, 0.3, 0.3), 45, 45, 10), (3, (0, 0, 0), 45, 45, 90),
         (3, (1, 1, 1), 45, 45, 90), (2.4, (0.3, 0.3, 0.3), 10, 85, 180), (2.4, (0.3, 0.3, 0.3), 10, 75, 20),
         (1, (0.2, 0.2, 0.2), 60, 60, 120), (10, (0.2, 0.2, 0.2), 30, 30, 60), (6.7, (0.5, 0.5, 0.5), 0, 80, 45),
         (4, (0.9, 0.3, 0.1), 70, 88, 250), (4, (0.1, 0.4, 0.8), 90, 50, 0)]


def between(height, theta, azimuth):
    """The angle from the sun, radians."""
    s = math.radians(90 - height)
    t = math.radians(theta)
    cosine = math.cos(s) * math.cos(t) + math.sin(s) * math.sin(t) * math.cos(math.radians(azimuth))
    return math.acos(max(-1, min(1, cosine)))


def print_expected(data):
    for turbidity, albedo, height, theta, azimuth in LOOKS:
        view = (math.radians(height), math.radians(theta), between(height, theta, azimuth))
        value = [x / Y_INTEGRAL for x in rgb(data, turbidity, albedo, *view)]
        words = ", ".join(f"{x:.7g}" for x in value)
        print(f"      {{{turbidity}, {{{albedo[0]}, {albedo[1]}, {albedo[2]}}}, {height}, {theta}, {azimuth}, "
              f"{{{words}}}}},")
    # Sums over all numbers of a channel, plain and with weights 1, 2, 3, ... modulo 101 by place: any digit shows.
    for channel in "123":
        for name in ("datasetXYZ", "datasetXYZRad"):
            numbers = data[name + channel]
            weighted = math.fsum(x * (i % 101 + 1) for i, x in enumerate(numbers))
            print(name + channel, len(numbers), f"{math.fsum(numbers):.9f}", f"{weighted:.7f}")
    # On level ground, lux: 683 lm/W times the integral of Y cos(theta), a lattice of equal steps of cos^2 and azimuth.
    for turbidity, height in ((2, 30), (2, 60), (3, 30), (3, 60), (5, 60)):
        steps, total = 200, 0
        for i in range(steps):
            theta = math.acos(math.sqrt((i + 0.5) / steps))
            for j in range(steps):
                gamma = between(height, math.degrees(theta), (j + 0.5) * 360 / steps)
                total += channel_radiance(data, 2, turbidity, 0.3, math.radians(height), theta, gamma)
        print("diffuse illuminance", turbidity, height, f"{total / steps**2 * math.pi * 683.002:.0f} lx")


if __name__ == "__main__":
    {"table": write_table, "expected": print_expected}[sys.argv[1]](arrays(sys.argv[2]))
