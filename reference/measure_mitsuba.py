#!/usr/bin/env python3
"""Measures Mitsuba's pictures of the scene library against our integrators.

  reference/measure_mitsuba.py build/release/bin/photonproof --keep out/mitsuba [--update] [SCENE ...]

Each scene is rendered by Mitsuba once and by an integrator of ours with four seeds. The printed line has the difference of
the means and its standard error, from Mitsuba's batches and the spread of our four. Pictures that the folder of --keep has
are used again. With --update all scenes of that folder go to the table reports/published/mitsuba.md.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess

from measure_library import LIBRARY, ROOT, integrator_of

SEEDS = (100, 101, 102, 103)
# Samples a pixel of ours, by integrator: bdpt traces many paths for one.
OURS = {"path": 128, "volpath": 128, "bdpt": 32}
AIMED = 0.3  # percent
FURNACE = "Mitsuba departs by .07 to .16 % in furnaces with a sphere"
CAUSES = {"furnace": FURNACE}


def run(words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)


def rendered(program, scene, options):
    """The stats of Mitsuba's picture, or the sentence by which the scene is refused."""
    image, stats = options.keep / f"{scene}.exr", options.keep / f"{scene}.stats.json"
    if not image.exists():
        done = run([program, "mitsuba", LIBRARY / scene / "scene.xml", "-o", image, "--size", f"{options.size}x{options.size}",
                    "--spp", options.spp, "--quiet"])
        if done.returncode == 3:
            return done.stderr.strip().split("\n")[-1].split("not representable in Mitsuba: ")[1]
        if done.returncode != 0:
            raise SystemExit(f"{scene}: {done.stderr.strip()}")
    return json.loads(stats.read_text())


def difference(program, scene, seed, options):
    """Of the means, in percent, to our picture of this seed."""
    ours = options.keep / f"{scene}-ref{SEEDS.index(seed)}.exr"
    integrator = integrator_of(scene)
    if not ours.exists():
        done = run([program, "render", LIBRARY / scene / "scene.xml", "-o", ours, "--integrator", integrator, "--size",
                    f"{options.size}x{options.size}", "--spp", OURS[integrator], "--seed", seed, "--quiet"])
        if done.returncode != 0:
            raise SystemExit(f"{scene}: {done.stderr.strip()}")
    done = run([program, "compare", ours, options.keep / f"{scene}.exr", "--json", "--metrics", "bias"])
    return 100 * json.loads(done.stdout)["metrics"][0]["value"]


def measure(program, scene, options):
    stats = rendered(program, scene, options)
    if isinstance(stats, str):
        return stats
    differences = [difference(program, scene, seed, options) for seed in SEEDS]
    error = math.hypot(100 * stats["relative_standard_error"], statistics.stdev(differences) / math.sqrt(len(SEEDS)))
    return {"mean": statistics.fmean(differences), "error": error, "seconds": stats["cpu_seconds"],
            "spp": stats["samples_per_pixel"], "variant": stats["variant"], "version": stats["version"]}


def row(scene, found):
    if isinstance(found, str):
        return f"| `{scene}` | refused: {found} | | |"
    cause = CAUSES.get(scene.split("-")[0], "")
    far = abs(found["mean"]) > 3 * found["error"] and abs(found["mean"]) > 0.05
    note = f" ({cause})" if cause and far else ""
    return f"| `{scene}` | {found['mean']:+.3f} ± {found['error']:.3f} %{note} | {found['seconds']:.1f} | {found['spp']} |"


def write_table(found):
    figures = [value for value in found.values() if not isinstance(value, str)]
    versions = " and ".join(sorted({f"{value['version']} ({value['variant']})" for value in figures}))
    within = sum(abs(value["mean"]) <= AIMED for value in figures)
    noisy = sum(abs(value["mean"]) > AIMED and abs(value["mean"]) <= 3 * value["error"] for value in figures)
    (ROOT / "reports" / "published" / "mitsuba.md").write_text(
        "# Mitsuba on the scene library\n\n```sh\nreference/measure_mitsuba.py build/release/bin/photonproof --keep out/mitsuba "
        f"--update\n```\n\n{versions} at 64x64, with seconds of processor time and samples a pixel. The mean is compared with that of `path`. "
        "Where mirrors or narrow holes hide the light it is that of `bdpt`, and with media that of `volpath`. Beside it stands "
        f"the standard error of the difference. Of {len(found)} scenes {len(figures)} are rendered and the others refused. {within} means are within "
        f"{AIMED} %, and {noisy} more within three standard errors.\n\n"
        "| scene | mean | s | spp |\n|---|--:|--:|--:|\n" + "\n".join(row(*pair) for pair in found.items()) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, required=True)
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--spp", type=int, default=512)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("scenes", nargs="*")
    options = parser.parse_intermixed_args()
    options.keep.mkdir(parents=True, exist_ok=True)
    everything = sorted(path.parent.name for path in LIBRARY.glob("*/scene.xml"))
    found = {}
    for scene in options.scenes or everything:
        found[scene] = measure(options.program, scene, options)
        print(row(scene, found[scene]), flush=True)
    if options.update:
        write_table(found)


if __name__ == "__main__":
    main()
