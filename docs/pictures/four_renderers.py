#!/usr/bin/env python3
"""Makes four-renderers.png: one caustic by four renderers, with their times and errors, and its caption in README.md.

  four_renderers.py PROGRAM     PROGRAM: photonproof; POV-Ray is on the PATH

PYTHON has the packages mitsuba, numpy and pillow (harness/oracles/nightly.sh makes such an environment). POV-Ray's
photons need one thread, the others have two. Mitsuba's path tracer takes as many samples as fit into the time. The
error is relmse_trimmed of the picture against a minute of bidirectional paths.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mitsuba
import numpy
from PIL import Image, ImageDraw, ImageFont

here = Path(__file__).resolve().parent
root = here.parents[1]
scene = root / "scenes/library/caustic-glass/scene.xml"
side, seconds, threads = 256, 2.0, 2


def run(*command):
    begin = time.perf_counter()
    subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - begin


def by_photonproof(program, image, *options):
    return run(program, "render", scene, "-o", image, "--size", f"{side}x{side}", "--threads", threads, "--quiet", *options)


def by_povray(program, image):
    return run(program, "povray", scene, "-o", image, "--size", f"{side}x{side}", "--quality", "draft")


def by_mitsuba(image):
    """The first render also compiles the kernel, which is not counted."""
    mitsuba.set_variant("llvm_ad_rgb")
    import drjit
    drjit.set_thread_count(threads)
    loaded = mitsuba.load_file(str(scene), size=side)

    def rendered(spp, seed):
        begin = time.perf_counter()
        picture = numpy.array(mitsuba.render(loaded, spp=spp, seed=seed))
        return picture, time.perf_counter() - begin

    rendered(16, 1)
    pilot = rendered(16, 2)[1]
    picture, took = rendered(max(1, round(16 * seconds / pilot)), 3)
    mitsuba.Bitmap(picture[:, :, :3]).write(str(image))
    return took


def pixels(image):
    bitmap = mitsuba.Bitmap(str(image))
    names = [field.name for field in bitmap.struct_()]
    linear = numpy.array(bitmap)[:, :, [names.index(channel) for channel in "RGB"]]
    encoded = numpy.clip(linear, 0, 1)
    encoded = numpy.where(encoded <= 0.0031308, 12.92 * encoded, 1.055 * encoded ** (1 / 2.4) - 0.055)
    return Image.fromarray((255 * encoded + 0.5).astype(numpy.uint8))


def error(program, reference, image):
    outcome = subprocess.run([program, "compare", reference, image, "--metrics", "relmse_trimmed", "--json"],
                             capture_output=True, text=True, check=True)
    return json.loads(outcome.stdout)["metrics"][0]["value"]


def rows_of(program, folder):
    """(name, seconds, error, file) of each renderer."""
    reference = folder / "reference.exr"
    by_photonproof(program, reference, "--integrator", "bdpt", "--seconds", 60, "--seed", 7)
    rows = []
    for name, render in (
            ("photonproof, photon mapper", lambda f: by_photonproof(program, f, "--integrator", "photonmapper", "--seconds", seconds)),
            ("photonproof, path tracer", lambda f: by_photonproof(program, f, "--integrator", "path", "--seconds", seconds)),
            (f"Mitsuba {mitsuba.__version__}, path tracer", by_mitsuba),
            ("POV-Ray 3.7, photons", lambda f: by_povray(program, f))):
        file = folder / f"{len(rows)}.exr"
        took = render(file)
        rows.append({"renderer": name, "seconds": round(took, 2), "relmse_trimmed": error(program, reference, file),
                     "file": str(file)})
    return rows


def draw(rows):
    gap, caption = 4, 22
    sheet = Image.new("RGB", (len(rows) * (side + gap) - gap, side + caption), "white")
    font = ImageFont.truetype("DejaVuSans.ttf", 12)
    for place, row in enumerate(rows):
        sheet.paste(pixels(row["file"]), (place * (side + gap), 0))
        ImageDraw.Draw(sheet).text((place * (side + gap) + 2, side + 4), f"{row['renderer']}: {row['seconds']:.2g} s",
                                   fill="black", font=font)
    sheet.save(here / "four-renderers.png", optimize=True)


def processor():
    return re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())[1]


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        rows = rows_of(program, Path(folder))
        draw(rows)
    for row in rows:
        del row["file"]
    record = {"scene": "caustic-glass", "size": side, "threads": threads, "processor": processor(),
              "date": time.strftime("%Y-%m-%d"), "rows": rows}
    (here / "four-renderers.json").write_text(json.dumps(record, indent=2) + "\n")
    figures = ", ".join(f"{row['relmse_trimmed']:.2g} {row['renderer'].removeprefix('photonproof, ')}" for row in rows)
    sentence = (f"*`caustic-glass`, {side}×{side}, {threads} threads of an {processor().split(' Processor')[0]}. The relMSE "
                f"without the worst 0.1 % of pixels: {figures}.*")
    page = root / "README.md"
    page.write_text(re.sub(r"^\*(The scene )?`caustic-glass`.*\*$", lambda _: sentence, page.read_text(), count=1, flags=re.MULTILINE))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(os.path.abspath(sys.argv[1]))
