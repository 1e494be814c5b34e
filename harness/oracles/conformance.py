#!/usr/bin/env python3
"""Renders Mitsuba's own render tests by photonproof and judges the images as Mitsuba's test_renders.py does.

    PYTHON harness/oracles/conformance.py build/release/bin/photonproof FOLDER
    PYTHON harness/oracles/conformance.py build/release/bin/photonproof FOLDER --with-mitsuba out/references

FOLDER is tests/scenes of the public repository mitsuba-data, or has scenes of one's own: every file
GROUP/test_NAME_INTEGRATOR.xml is a test. Its reference is GROUP/refs/test_NAME_ref_rgb.exr and the variance of one sample is
beside it, test_NAME_ref_rgb_var.exr. With --with-mitsuba, Mitsuba renders both into a folder first, as `moment` over the
scene's integrator (`path` in place of `ptracer`, which has no moments), and keeps them for the next run. PYTHON has the
packages mitsuba and numpy.

The image has S samples a pixel, 2e6 in all. The statistic of a pixel and channel is
  z = |image - reference| / sqrt(var / S + var / R),  var at least 1e-4,
where R is the number of samples of the reference. A test passes when 99.75 % of the values are likelier than 1 %, with
Sidak's correction for the number of pixels. Mitsuba compares X, Y and Z, since `moment` measures their variances. Its variance files
hold the linear map of these to RGB: that is no variance of RGB, and negative where a colour is saturated.
A reference of few samples underestimates the variance of rare bright paths, and right images fail: Mitsuba's own do, too.

A line of the table has
  accepted  the share of values of X, Y and Z that pass, which decides
  RGB       the share of pixels whose three values of RGB pass by the variance file as it is
  ratio     the mean of the image divided by the reference's, in the channel that differs most, with its standard error
  block     the largest difference of a block of 8 x 8 pixels, in per cent of the mean of the image or of the block, whichever
            is larger, and in standard errors
"""
import argparse
import math
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from mitsuba_parameters import load_mitsuba

BUDGET = 2_000_000   # samples of an image
STORED = 32_000      # samples a pixel of the references of mitsuba-data
LEAST_VARIANCE = 1e-4
SIGNIFICANCE = 0.01
ACCEPTED = 0.9975
BLOCK = 8


class Images:
    """Reads and writes images by Mitsuba, in RGB or XYZ."""

    def __init__(self, mitsuba):
        self.mi = mitsuba

    def read(self, path, colours):
        layers = dict(self.mi.Bitmap(str(path)).split())
        bitmap = layers.get("<root>", next(iter(layers.values())))
        return np.array(bitmap.convert(getattr(self.mi.Bitmap.PixelFormat, colours), self.mi.Struct.Type.Float32,
                                       False)).astype(float)

    def write_xyz(self, path, image):
        bitmap = self.mi.Bitmap(image.astype(np.float32), self.mi.Bitmap.PixelFormat.XYZ)
        bitmap.convert(self.mi.Bitmap.PixelFormat.RGB, self.mi.Struct.Type.Float32, False).write(str(path))


def integrator_of(scene):
    return scene.stem.rsplit("_", 1)[1]


def reference_paths(scene, folder):
    name = scene.stem.rsplit("_", 1)[0]
    return folder / f"{name}_ref_rgb.exr", folder / f"{name}_ref_rgb_var.exr"


def samples_of(size):
    return math.ceil(BUDGET / (size[0] * size[1]))


def render_reference(mitsuba, images, scene, paths, times):
    """The mean and the variance of a sample, in rounds that fit in memory."""
    defaults = {"integrator": "path"} if integrator_of(scene) == "ptracer" else {}
    loaded = mitsuba.load_file(str(scene), spp=16, **defaults)
    integrator = loaded.integrator()
    if not any(name.startswith("m2_") for name in integrator.aov_names()):
        integrator = mitsuba.load_dict({"type": "moment", "inner": integrator})
    size = loaded.sensors()[0].film().size()
    total = sum(np.array(mitsuba.render(loaded, integrator=integrator, spp=samples_of(size), seed=1000 + k)).astype(float)
                for k in range(times)) / times
    mean, square = total[..., -6:-3], total[..., -3:]
    paths[0].parent.mkdir(parents=True, exist_ok=True)
    images.write_xyz(paths[0], mean)
    images.write_xyz(paths[1], square - mean**2)


def likelihoods(z):
    return np.vectorize(math.erfc)(np.abs(z) / math.sqrt(2))


def accepted_values(image, reference, variance, samples, reference_samples):
    spread = np.sqrt(np.maximum(variance, LEAST_VARIANCE) * (1 / samples + 1 / reference_samples))
    pixels = image.shape[0] * image.shape[1]
    return likelihoods((image - reference) / spread) > 1 - (1 - SIGNIFICANCE)**(1 / pixels)


def worst_block(image, reference, squared_errors):
    """(difference over the mean, difference over its standard error) of the block with the largest of the latter."""
    floor = reference.mean(axis=(0, 1))
    worst = (0.0, 0.0)
    for y in range(0, image.shape[0], BLOCK):
        for x in range(0, image.shape[1], BLOCK):
            part = np.s_[y:y + BLOCK, x:x + BLOCK]
            there = reference[part].mean(axis=(0, 1))
            off = image[part].mean(axis=(0, 1)) - there
            count = image[part].shape[0] * image[part].shape[1]
            errors = np.abs(off) / np.sqrt(squared_errors[part].mean(axis=(0, 1)) / count)
            channel = int(np.argmax(errors))
            if errors[channel] > worst[1]:
                worst = (float(off[channel] / max(floor[channel], there[channel], 1e-9)), float(errors[channel]))
    return worst


def judge(images, output, paths, samples, reference_samples):
    """The fields of a line, and whether the test passes."""
    image, reference, variance = (images.read(path, "XYZ") for path in (output, *paths))
    if image.shape != reference.shape:
        return f"| {image.shape[1]}x{image.shape[0]} pixels, the reference {reference.shape[1]}x{reference.shape[0]} |", False
    accepted = accepted_values(image, reference, variance, samples, reference_samples).mean()
    in_rgb = accepted_values(*(images.read(path, "RGB") for path in (output, *paths)), samples, reference_samples).all(axis=2).mean()
    squared_errors = np.maximum(variance, 1e-9) * (1 / samples + 1 / reference_samples)
    means, there = image.mean(axis=(0, 1)), reference.mean(axis=(0, 1))
    channel = int(np.argmax(np.abs(means / np.maximum(there, 1e-9) - 1)))
    error = math.sqrt(squared_errors[..., channel].mean() / (image.shape[0] * image.shape[1])) / max(there[channel], 1e-9)
    off, errors = worst_block(image, reference, squared_errors)
    right = bool(np.isfinite(image).all()) and accepted >= ACCEPTED
    return (f"{100 * accepted:.2f} % | {100 * in_rgb:.2f} % | {means[channel] / max(there[channel], 1e-9):.4f} ±{error:.4f} | "
            f"{100 * off:+.1f} %, {errors:.1f} s.e. | {'pass' if right else 'FAIL'} |"), right


def run_test(scene, arguments, images):
    folder = arguments.with_mitsuba / scene.parent.name if arguments.with_mitsuba else scene.parent / "refs"
    paths = reference_paths(scene, folder)
    if not all(path.exists() for path in paths):
        if not arguments.with_mitsuba:
            return "| | | | no reference |", None
        try:
            render_reference(images.mi, images, scene, paths, arguments.times)
        except Exception as refusal:  # Mitsuba throws RuntimeError and others
            return f"| | | | Mitsuba: {' '.join(str(refusal).split())[-90:]} |", None
    reference = images.read(paths[0], "XYZ")
    samples = samples_of(reference.shape)
    output = arguments.output / f"{scene.stem}.exr"
    run = subprocess.run([arguments.program, "render", scene, "-o", output, "--spp", str(samples), "-D", f"spp={samples}", "--seed", str(arguments.seed),
                          "--allow-outside", "--quiet", "--checkpoint", "0", *arguments.option], capture_output=True, text=True)
    if run.returncode:
        return f"| | | | FAIL: {run.stderr.strip().splitlines()[0] if run.stderr.strip() else run.returncode} |", False
    return judge(images, output, paths, samples, arguments.times * samples if arguments.with_mitsuba else STORED)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="the photonproof program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--with-mitsuba", type=Path, metavar="REFERENCES", help="a folder for references that Mitsuba renders")
    parser.add_argument("--times", type=int, default=20, help="how many times as many samples those references have: below 16, right images fail")
    parser.add_argument("--only", default="", metavar="REGEX", help="tests whose names match")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--option", action="append", default=[], help="a word for photonproof's command line; repeatable")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/conformance"), help="for our images")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    arguments.program = arguments.program.resolve()
    arguments.output.mkdir(parents=True, exist_ok=True)
    images = Images(load_mitsuba(arguments.variant))
    verdicts = []
    print("| test | accepted | RGB | ratio | block | verdict |\n| --- | --- | --- | --- | --- | --- |")
    for scene in sorted(arguments.folder.glob("*/test_*_*.xml")):
        if not re.search(arguments.only, scene.stem):
            continue
        started = time.time()
        line, right = run_test(scene, arguments, images)
        verdicts.append(right)
        print(f"| {scene.stem} | {line}", flush=True)
        print(f"{scene.stem}: {time.time() - started:.0f} s", file=sys.stderr)
    passed, failed = verdicts.count(True), verdicts.count(False)
    print(f"\n{passed} pass, {failed} fail, {verdicts.count(None)} without a reference")
    return 1 if failed or not verdicts else 0


if __name__ == "__main__":
    sys.exit(main())
