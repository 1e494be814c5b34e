#!/usr/bin/env python3
"""Makes showcase.png: the six scenes of scenes/showcase, each by its own integrator at its own size and samples.

  showcase.py PROGRAM [FOLDER]     PROGRAM: photonproof; FOLDER keeps the renders, and those in it are not made again

PYTHON has the packages mitsuba and numpy (harness/oracles/nightly.sh makes such an environment). The processor time of
each new render is printed.
"""
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba
import numpy

mitsuba.set_variant("scalar_rgb")
here = Path(__file__).resolve().parent
scenes = here.parents[1] / "scenes/showcase"
rows = (("glass-interior", "door-ajar", "ring-caustic"), ("murky-pool", "foggy-stage", "gallery"))
width, height, gap = 304, 228, 4


def render(program, name, image):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "render", scenes / name / "scene.xml", "-o", image, "--quiet"], check=True)
    print(f"{name}: {resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before:.0f} s of processor time")


def tile(image):
    """Encoded sRGB, scaled down in linear light."""
    bitmap = mitsuba.Bitmap(str(image))
    names = [field.name for field in bitmap.struct_()]
    linear = numpy.clip(numpy.array(bitmap)[:, :, [names.index(channel) for channel in "RGB"]], 0, 1)
    small = mitsuba.Bitmap(linear.astype(numpy.float32)).resample([width, height], clamp=(0, 1))
    pixels = numpy.array(small)
    encoded = numpy.where(pixels <= 0.0031308, 12.92 * pixels, 1.055 * numpy.maximum(pixels, 1e-6) ** (1 / 2.4) - 0.055)
    return (255 * encoded + 0.5).astype(numpy.uint8)


def main(program, folder):
    across, down = len(rows[0]), len(rows)
    sheet = numpy.full((down * (height + gap) - gap, across * (width + gap) - gap, 3), 255, numpy.uint8)
    for j, row in enumerate(rows):
        for i, name in enumerate(row):
            image = folder / f"{name}.exr"
            if not image.exists():
                render(program, name, image)
            y, x = j * (height + gap), i * (width + gap)
            sheet[y:y + height, x:x + width] = tile(image)
    mitsuba.Bitmap(sheet).write(str(here / "showcase.png"), quality=9)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    if len(sys.argv) == 3:
        main(os.path.abspath(sys.argv[1]), Path(sys.argv[2]))
    else:
        with tempfile.TemporaryDirectory() as scratch:
            main(os.path.abspath(sys.argv[1]), Path(scratch))
