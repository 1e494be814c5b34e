#!/usr/bin/env python3
"""Measures how time and memory grow with triangles, photons, lights and pixels.

  harness/oracles/scaling.py PROGRAM [--repetitions 3] [--quick] [-o FILE.md] [--picture FILE.svg]

Each point is the least processor time of several runs of the whole process, and the largest resident memory of these
runs. The repetitions of all points are interleaved, so that a disturbance meets all sizes alike. The exponent is the
slope of a least-squares line through the logarithms of the four largest sizes: 1 is linear growth, 0 is none.
Standard library only; about twenty minutes on two cores, --quick takes one.
"""
import argparse
import collections
import math
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

import scaling_picture

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "library"
Series = collections.namedtuple("Series", "sweep engine sizes command")
Point = collections.namedtuple("Point", "seconds bytes")


def powers(first, last, step=1):
    return [10 ** e for e in range(first, last + 1, step)]


def all_series(folder, quick):
    """Every sweep with its command: a function from a size to the arguments of `photonproof render`."""
    spheres = str(LIBRARY / "cornell-spheres" / "scene.xml")
    triangles = powers(3, 5 if quick else 7)
    lights = powers(0, 3 if quick else 5)
    photons = powers(4, 6 if quick else 8)
    pixels = [64, 128, 256] if quick else [64, 128, 256, 512, 1024, 2048]
    rows = []
    for engine in ("path", "photonmapper"):
        rows.append(Series("triangles", engine, triangles, lambda n, e=engine: [
            f"{folder}/million-{n}/scene.xml", "--integrator", e, "--size", "128x128", "--spp", "16"]))
        rows.append(Series("lights", engine, lights, lambda n, e=engine: [
            f"{folder}/many-lights-{n}/scene.xml", "--integrator", e, "--size", "128x128", "--spp", "16"]))
        rows.append(Series("pixels", engine, [n * n for n in pixels], lambda n, e=engine: [
            spheres, "--integrator", e, "--size", f"{math.isqrt(n)}x{math.isqrt(n)}", "--spp", "16"]))
    rows.append(Series("photons", "photonmapper", photons, lambda n: [
        spheres, "--integrator", "photonmapper", "--size", "128x128", "--photons", str(n)]))
    return rows


def generate(program, folder, series):
    for row in series:
        for size in row.sizes:
            for sweep, verb, option in (("triangles", "million", "--triangles"), ("lights", "many-lights", "--lights")):
                target = pathlib.Path(folder) / f"{verb}-{size}"
                if row.sweep == sweep and not target.exists():
                    subprocess.run([program, "generate", verb, option, str(size), "-o", target], check=True,
                                   stdout=subprocess.DEVNULL)


def measured(program, folder, arguments):
    command = [program, "render", *arguments, "--checkpoint", "0", "--quiet", "-o", f"{folder}/image.exr"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    message = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"scaling: {' '.join(map(str, command))} exited with {process.returncode}: {message}")
    return Point(usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def measure_all(program, folder, series, repetitions):
    points = {}
    for repetition in range(repetitions):
        for row in series:
            for size in row.sizes:
                point = measured(program, folder, row.command(size))
                key = row.sweep, row.engine, size
                before = points.get(key, point)
                points[key] = Point(min(before.seconds, point.seconds), max(before.bytes, point.bytes))
        print(f"scaling: repetition {repetition + 1} of {repetitions}", file=sys.stderr)
    return points


def exponent(sizes, values):
    """Slope of log value over log size, through the four largest sizes."""
    x, y = [math.log(v) for v in sizes[-4:]], [math.log(v) for v in values[-4:]]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def processor():
    for line in open("/proc/cpuinfo", encoding="utf-8"):
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def table(series, points):
    version = " ".join(subprocess.run([ARGUMENTS.program, "--version"], capture_output=True, text=True,
                                      check=True).stdout.split())
    lines = ["# Scaling", "",
             f"Processor seconds and peak memory of whole processes of {version}, on {processor()},",
             f"{os.cpu_count()} threads. Each time is the least of {ARGUMENTS.repetitions} interleaved runs. Exponents are",
             "slopes through the four largest sizes.", "",
             "`harness/oracles/scaling.py build/release/bin/photonproof -o reports/published/scaling.md --picture "
             "docs/pictures/scaling.svg`", ""]
    for row in series:
        cells = [points[row.sweep, row.engine, size] for size in row.sizes]
        seconds, memory = [c.seconds for c in cells], [c.bytes for c in cells]
        lines += [f"## {row.sweep}, {row.engine}", "",
                  f"Time grows with exponent {exponent(row.sizes, seconds):.2f}, memory with "
                  f"{exponent(row.sizes, memory):.2f}.", "", f"| {row.sweep} | processor s | peak MB |", "|---|---|---|"]
        lines += [f"| {size:,} | {cell.seconds:.2f} | {cell.bytes / 1e6:.0f} |" for size, cell in zip(row.sizes, cells)]
        lines.append("")
    return "\n".join(lines)


def write(path, text):
    temporary = pathlib.Path(f"{path}.part")
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


def main():
    with tempfile.TemporaryDirectory() as folder:
        series = all_series(folder, ARGUMENTS.quick)
        generate(ARGUMENTS.program, folder, series)
        points = measure_all(ARGUMENTS.program, folder, series, ARGUMENTS.repetitions)
    text = table(series, points)
    print(text) if ARGUMENTS.output is None else write(ARGUMENTS.output, text)
    if ARGUMENTS.picture:
        write(ARGUMENTS.picture, scaling_picture.drawn(series, points))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--quick", action="store_true", help="small sizes alone")
    parser.add_argument("-o", dest="output", help="file of the tables; without it they are printed")
    parser.add_argument("--picture", help="SVG of the plots")
    ARGUMENTS = parser.parse_args()
    main()
