"""The sky and the sun of Hosek and Wilkie, as Mitsuba's `sunsky` has them: writes the renderer's tables, and prints the
values that its tests expect.

    pip install mitsuba==3.9.1 numpy
    python3 harness/oracles/sky_oracle.py sky > scenes/sky/sky_hosek_wilkie_table.cpp
    python3 harness/oracles/sky_oracle.py sun > scenes/sky/sun_irradiance_table.cpp
    python3 harness/oracles/sky_oracle.py expected

The tables come from the data files of Mitsuba's package: the authors' fit of the sky for the channels of Rec. 709
(2012), and the mean irradiance of their sun (2013) at 11 wavelengths. The expected values are what the plugin itself
returns, so they share no code with the renderer.
"""
import math
import os
import struct
import sys

import mitsuba as mi
import numpy as np

LICENCE = """\
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
"""

NAMES = {"sky": """\
// Coefficients of the sky model of Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", for
// the red, green and blue of Rec. 709, version 1.4a of the authors' data, from sunsky_datasets.bin of Mitsuba 3.9.1.
// Written by harness/oracles/sky_oracle.py. The data's licence:
//
""", "sun": """\
// Irradiance of the sun of Hosek and Wilkie 2013, "Adding a Solar-Radiance Function to the Hosek-Wilkie Skylight Model",
// from sampling_data.bin of Mitsuba 3.9.1: ten turbidities from 1, each with 30 heights from 2 to 89 degrees.
// Written by harness/oracles/sky_oracle.py. The data's licence:
//
"""}
END = "// clang-format on\n}  // namespace photonproof"


def fields(name):
    """The arrays of one of Mitsuba's tensor files."""
    data = open(os.path.join(os.path.dirname(mi.__file__), "data", "sunsky", name), "rb").read()
    count, = struct.unpack_from("<I", data, 14)
    at, found = 18, {}
    for _ in range(count):
        length, = struct.unpack_from("<H", data, at)
        key = data[at + 2:at + 2 + length].decode()
        at += 2 + length
        dimensions, kind, offset = struct.unpack_from("<HBQ", data, at)
        shape = struct.unpack_from(f"<{dimensions}Q", data, at + 11)
        at += 11 + 8 * dimensions
        found[key] = np.frombuffer(data, {10: "<f4", 11: "<f8"}[kind], math.prod(shape), offset).reshape(shape)
    return found


def head(kind, header):
    print(NAMES[kind] + LICENCE + f'#include "{header}"\n\nnamespace photonproof {{\n// clang-format off\n')


def sky_tables():
    """Parameters and means of each channel, by albedo, turbidity and Bezier point."""
    data = fields("sunsky_datasets.bin")
    shape = data["sky_params_rgb"].transpose(3, 1, 0, 2, 4)
    mean = data["sky_rad_rgb"].transpose(3, 1, 0, 2)
    return [(shape[i].reshape(-1, 9), mean[i].reshape(-1, 6)) for i in range(3)]


def rows(numbers):
    for row in numbers:
        print("    " + ", ".join(f"{x:.7g}" for x in row) + ",")


def write_sky():
    head("sky", "scenes/sky/sky_hosek_wilkie.h")
    print("const std::array<HosekWilkieTable, 3> hosek_wilkie_tables{{")
    for shape, mean in sky_tables():
        print("  {{")
        rows(shape)
        print("  }, {")
        rows(mean)
        print("  }},")
    print("}};\n\n" + END)


def sun_table():
    """W m^-2 nm^-1 as linear Rec. 709: the mean over the 11 wavelengths of the CIE's functions, by Mitsuba's factor."""
    to_rgb = np.array([[3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556], [0.055648, -0.204043, 1.057311]])
    cie = np.array([[float(x) for x in mi.cie1931_xyz(320.0 + 40 * i)] for i in range(11)])
    spectra = fields("sampling_data.bin")["sun_irradiance"].astype(float)
    return spectra @ cie @ to_rgb.T / 11 * 467.069280386 / 106.7502593994140625


def write_sun():
    head("sun", "scenes/sky/sun_irradiance.h")
    print("const std::array<std::array<double, 3>, sun_turbidities * sun_heights> sun_irradiance_table{{")
    for turbidity in sun_table():
        for i in range(0, len(turbidity), 3):
            print("  " + " ".join("{" + ", ".join(f"{x:.7g}" for x in rgb) + "}," for rgb in turbidity[i:i + 3]))
    print("}};\n\n" + END)


def direction(theta, azimuth):
    theta, azimuth = math.radians(theta), math.radians(azimuth)
    return [math.sin(theta) * math.cos(azimuth), math.sin(theta) * math.sin(azimuth), math.cos(theta)]


def radiance(towards, albedo=(0.3, 0.3, 0.3), **parameters):
    emitter = mi.load_dict({"type": "sunsky", "albedo": {"type": "rgb", "value": list(albedo)}, **parameters})
    at = mi.SurfaceInteraction3f()
    at.wi, at.time = mi.Vector3f(*(-x for x in towards)), 0
    return [float(x) for x in emitter.eval(at)]


def words(values):
    return "{" + ", ".join(f"{x:.7g}" for x in values) + "}"


# Turbidity, albedo, the sun's height above the horizon, the view's angle from the zenith, its azimuth from the sun's.
LOOKS = [(3, (0.3, 0.3, 0.3), 45, 0, 0), (3, (0.3, 0.3, 0.3), 45, 45, 10), (3, (0, 0, 0), 45, 45, 90),
         (3, (1, 1, 1), 45, 45, 90), (2.4, (0.3, 0.3, 0.3), 10, 85, 180), (2.4, (0.3, 0.3, 0.3), 10, 75, 20),
         (1, (0.2, 0.2, 0.2), 60, 60, 120), (10, (0.2, 0.2, 0.2), 30, 30, 60), (6.7, (0.5, 0.5, 0.5), 1, 80, 45),
         (4, (0.9, 0.3, 0.1), 70, 88, 250), (4, (0.1, 0.4, 0.8), 90, 50, 0)]
# Turbidity, the sun's height.
SUNS = [(2, 90), (3, 30), (6, 10), (1, 15), (10, 60), (2.5, 3.5), (7.25, 1), (4.4, 44)]


def write_expected():
    for turbidity, albedo, height, theta, azimuth in LOOKS:
        value = radiance(direction(theta, azimuth), albedo, turbidity=float(turbidity), sun_scale=0.0,
                         sun_direction=direction(90 - height, 0))
        print(f"      {{{turbidity}, {words(albedo)}, {height}, {theta}, {azimuth}, {words(value)}}},")
    # A wide sun: single precision makes Mitsuba's 1 - cos of the common aperture 0.2 % too small.
    disc = 2 * math.pi * (1 - math.cos(math.radians(10)))
    for turbidity, height in SUNS:
        towards = direction(90 - height, 0)
        value = radiance(towards, turbidity=float(turbidity), sky_scale=0.0, sun_direction=towards, sun_aperture=20.0)
        # A negative blue counts as 0.
        print(f"      {{{turbidity}, {height}, {words([max(x * disc, 0) for x in value])}}},")
    # Sums over all numbers, plain and with weights 1, 2, 3, ... modulo 101 by place, so that any wrong digit shows.
    for shape, mean in sky_tables():
        sums = [(math.fsum(a.flat), math.fsum(x * (i % 101 + 1) for i, x in enumerate(a.flat))) for a in (shape, mean)]
        print("{" + ", ".join(f"{plain:.9f}, {weighted:.7f}" for plain, weighted in sums) + "}")
    numbers = sun_table().ravel()
    print(f"{math.fsum(numbers):.7g}, {math.fsum(x * (i % 101 + 1) for i, x in enumerate(numbers)):.7g}")
    for parameters in ({}, {"hour": 9.0}, {"month": 1, "day": 20, "hour": 12.0},
                       {"latitude": -33.9, "longitude": 151.2, "timezone": 10.0, "hour": 9.5}):
        print(parameters, mi.traverse(mi.load_dict({"type": "sunsky", **parameters}))["sun_direction"])


if __name__ == "__main__":
    mi.set_variant("scalar_rgb")
    {"sky": write_sky, "sun": write_sun, "expected": write_expected}[sys.argv[1]]()
