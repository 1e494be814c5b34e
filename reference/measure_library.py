#!/usr/bin/env python3
"""Measures another engine's pictures of the scene library against our reference integrators.

  reference/measure_library.py build/release/bin/photonproof --keep out/povray [--update] [SCENE ...]
  reference/measure_library.py build/release/bin/photonproof --engine cycles --keep out/cycles [--update] [SCENE ...]

Every scene is rendered by the engine (size and quality or samples as below, one thread). POV-Ray's picture is compared with
the library's own reference where the scene has one, of whose size it then is; all others with an integrator that shares
no code with the engine, for as long as `--seconds` says. The pictures stay in the folder that `--keep` names, and
references that are there are used again. POV-Ray's quality is raised, up to 3, until the residual is small or the next
would take more than 20 s; where the mean is off by more than 0.5 % then, paths are tried (4), and kept where their relmse
is lower. Where paths were, or the mean is off by more than is aimed for, noise or the cache may be why. There both,
POV-Ray by paths, are rendered anew, pair after pair with seeds of their own, until the mean of the pairs' differences is
known to a third of what is aimed for or there are `--pairs` of them. Printed is a line a scene. With --update the figures
go to [povray] or [cycles] of the scenes' expect.toml, whose `cause` is kept, and what all of them declare to the table in
reports/published/povray.md or cycles.md, measured by the same options or not.
"""

import argparse
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[1]
LIBRARY = ROOT / "scenes" / "library"
NAMES = {"povray": "POV-Ray", "cycles": "Cycles"}
# Option that sets the budget. Allowed error of the mean in percent. Residuals that need no stated cause.
BUDGET = {"povray": "quality", "cycles": "spp"}
AIMED = {"povray": 0.5, "cycles": 0.3}
SMALL = {
    "povray": lambda found: abs(found["mean_percent"]) <= AIMED["povray"] and found["ssim"] >= 0.98,
    "cycles": lambda found: all(abs(mean["mean_percent"]) <= max(AIMED["cycles"], 3 * mean["noise_percent"])
                                for mean in (found, found.get("pairs")) if mean),
}

# Pairs of images: factor on an image's samples, the least number of pairs, and the table's text.
TIMES_A_PAIR = 4
FEWEST_PAIRS = 8  # with four the spread was once a third of the true one
PAIRS = {
    "povray": "By pairs: where paths were or the mean is off by more than 0.5 %, its difference over images by paths (quality 4) of "
              "several seeds, each against a reference of its own, or the stored one.",
    "cycles": "By pairs: where the mean is off by more than 0.3 %, its difference over images of four times the samples "
              "and several seeds, each against a reference of its own.",
}

# POV-Ray's presets: the highest with a cache, the time factor to the next, and the most seconds for a scene. The last
# is the preset without a cache, used where the others are not accurate enough.
HIGHEST_QUALITY, TIMES_A_QUALITY, MOST_SECONDS, BY_PATHS = 3, 4, 20, 4

# Integrator of each scene's reference; `path` for scenes not listed.
INTEGRATORS = {
    "bdpt": ["cornell-spheres", "course-1", "caustic-glass", "mirror-light", "keyhole", "corridor", "course-2", "course-3",
             "pool", "water-caustic"],
    "ptracer": ["ball-lens"],
    "volpath": ["absorption", "albedo-one", "fog", "furnace-null", "haze", "milk", "mist"],
}

# POV-Ray's fisheye is written for square pictures only.
SQUARE = ["chart-fisheye"]


def integrator_of(scene):
    return next((name for name, scenes in INTEGRATORS.items() if scene in scenes), "path")


def run(words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)


def stored_reference(scene, options):
    """Width, height and file of a reference in the scene's folder, the widest. Cycles, which has no bias of its own, is
    held against a longer render."""
    stored = []
    for image in (LIBRARY / scene).glob("reference-*.exr") if options.engine == "povray" else []:
        width, height = map(int, re.fullmatch(r"reference-(\d+)x(\d+)", image.stem).groups())
        if width == height or scene not in SQUARE:
            stored.append((width, height, image))
    return max(stored, default=None)


def size_of(scene, options):
    stored = stored_reference(scene, options)
    return stored[:2] if stored else (options.size, options.size)


def reference_of(program, scene, options):
    stored = stored_reference(scene, options)
    if stored:
        return stored[2]
    image = options.keep / f"{scene}-reference-{options.size}.exr"
    if not image.exists():
        render_reference(program, scene, 7, image, options)
    return image


def render_reference(program, scene, seed, image, options):
    done = run([program, "render", LIBRARY / scene / "scene.xml", "-o", image, "--integrator", integrator_of(scene),
                "--size", f"{options.size}x{options.size}", "--seconds", options.seconds, "--seed", seed, "--quiet"])
    if done.returncode != 0:
        sys.exit(f"{scene}: {done.stderr.strip()}")


def measure(program, scene, options):
    """Figures of a scene at the least budget that is enough, or the sentence by which it is refused."""
    best = None
    budgets = range(options.quality, HIGHEST_QUALITY + 1) if options.engine == "povray" else [options.spp]
    for budget in budgets:
        found = measure_at(program, scene, budget, options)
        if isinstance(found, str):
            return found
        if best is None or abs(found["mean_percent"]) < abs(best["mean_percent"]) or SMALL[options.engine](found):
            best = found
        if SMALL[options.engine](best) or found["seconds"] * TIMES_A_QUALITY > MOST_SECONDS:
            break
    if options.engine == "povray" and abs(best["mean_percent"]) > AIMED["povray"]:
        found = measure_at(program, scene, BY_PATHS, options)
        best = min(best, found, key=lambda figures: figures["relmse"])
    if abs(best["mean_percent"]) > AIMED[options.engine] or best.get("quality") == BY_PATHS:
        best["pairs"] = measure_pairs(program, scene, options)
    return best


def measure_pairs(program, scene, options):
    """The mean's difference by images of several seeds of both, in percent, and its standard error. A reference that is
    stored is not rendered anew, and its noise not counted."""
    image, reference = (options.keep / f"{scene}-pair-{which}.exr" for which in ("engine", "reference"))
    budget = BY_PATHS if options.engine == "povray" else options.spp * TIMES_A_PAIR
    stored = stored_reference(scene, options)
    differences = []
    while len(differences) < options.pairs:
        seed = 101 + len(differences)
        render_by_engine(program, scene, budget, seed, image, options)
        if not stored:
            render_reference(program, scene, seed, reference, options)
        differences.append(100 * compared(program, stored[2] if stored else reference, image)["bias"])
        error = statistics.stdev(differences) / len(differences)**0.5 if len(differences) >= FEWEST_PAIRS else math.inf
        print(f"{scene}: pair {len(differences)}: {statistics.fmean(differences):+.2f} ± {error:.2f} %", file=sys.stderr)
        if error <= AIMED[options.engine] / 3:
            break
    return {"count": len(differences), "mean_percent": round(statistics.fmean(differences), 2) + 0.0,
            "noise_percent": round(error, 2)}


def render_by_engine(program, scene, budget, seed, image, options):
    """The stats of a render, or the sentence by which the scene is refused."""
    width, height = size_of(scene, options)
    words = [program, options.engine, LIBRARY / scene / "scene.xml", "-o", image, "--size", f"{width}x{height}",
             "--seed", seed, "--quiet", "--json", f"--{BUDGET[options.engine]}", budget]
    done = run(words + (["--threads", 1] if options.engine == "cycles" else []))
    if done.returncode == 3:
        return done.stderr.strip().split("\n")[-1].split(f"not representable in {NAMES[options.engine]}: ")[1]
    if done.returncode != 0:
        sys.exit(f"{scene}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def compared(program, reference, image):
    done = run([program, "compare", reference, image, "--json", "--metrics", "bias,relmse,ssim"])
    return {row["name"]: row["value"] for row in json.loads(done.stdout)["metrics"]}


def measure_at(program, scene, budget, options):
    image = options.keep / f"{scene}.exr"
    stats = render_by_engine(program, scene, budget, 1, image, options)
    if isinstance(stats, str):
        return stats
    metrics = compared(program, reference_of(program, scene, options), image)
    found = {BUDGET[options.engine]: budget, "mean_percent": round(100 * metrics["bias"], 2) + 0.0,
             "relmse": float(f"{metrics['relmse']:.1e}"), "ssim": round(metrics["ssim"], 4), "seconds": round(stats["cpu_seconds"], 1)}
    if options.engine == "cycles":
        found["noise_percent"] = round(100 * stats["relative_standard_error"], 3)
    return found


def without_table(text, name):
    return re.sub(rf"(?ms)^\n?\[{name}\]\n.*?(?=^\n?\[|\Z)", "", text)


def update_expect(scene, found, options):
    path = LIBRARY / scene / "expect.toml"
    text = path.read_text()
    name = options.engine
    cause = cause_in(text, name)
    text = without_table(text, name)
    text = re.sub(rf"(?m)^{name} = .*\n", "", text)
    text = re.sub(r"(?m)\n?^\[unsupported\]\n(?=\n?\[|\Z)", "", text)
    if isinstance(found, str):
        line = f"{name} = {json.dumps(found)}\n"
        if "[unsupported]\n" in text:
            text = text.replace("[unsupported]\n", "[unsupported]\n" + line)
        else:
            text = text.rstrip("\n") + "\n\n[unsupported]\n" + line
    else:
        table = f"[{name}]\nsize = {size_of(scene, options)[0]}\n"
        table += "".join(f"{key} = {as_toml(value)}\n" for key, value in found.items())
        if cause and not SMALL[name](found):
            table += f"cause = {cause}\n"
        if name == "cycles" and "[povray]\n" in text:
            text = text.replace("[povray]\n", table + "\n[povray]\n")
        else:
            text = text.rstrip("\n") + "\n\n" + table
    path.write_text(text)


def as_toml(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {number}" for key, number in value.items()) + "}"
    return str(value)


def cause_in(text, engine):
    """In its quotes; nothing where none is given."""
    table = re.search(rf"(?ms)^\[{engine}\]\n(.*?)(?=^\[|\Z)", text)
    cause = table and re.search(r"(?m)^cause = (.*)$", table.group(1))
    return cause and cause.group(1)


def table_row(scene, found, engine):
    if isinstance(found, str):
        return f"| `{scene}` | refused: {found} | | | | | |"
    cause = cause_in((LIBRARY / scene / "expect.toml").read_text(), engine)
    why = f" ({json.loads(cause)})" if cause and not SMALL[engine](found) else ""
    noise = f" ± {found['noise_percent']:.2f}" if engine == "cycles" else ""
    if pairs := found.get("pairs"):
        noise += f" %, by pairs {pairs['mean_percent']:+.2f} ± {pairs['noise_percent']:.2f}"
    return (f"| `{scene}` | {found['mean_percent']:+.2f}{noise} %{why} | {found['ssim']:.4f} | {found['relmse']:.1e} | "
            f"{found['seconds']:.1f} | {found[BUDGET[engine]]} | {found['size']} |")


def declared(scene, engine):
    """What the scene's expect.toml says of the engine: figures, a refusal, or nothing."""
    expect = tomllib.loads((LIBRARY / scene / "expect.toml").read_text())
    return expect.get(engine) or expect.get("unsupported", {}).get(engine)


def write_table(options):
    found = {path.parent.name: declared(path.parent.name, options.engine) for path in sorted(LIBRARY.glob("*/scene.xml"))}
    rows = [table_row(scene, figures, options.engine) for scene, figures in found.items() if figures]
    name = options.engine
    budget = f"{BUDGET[name]} {getattr(options, BUDGET[name])}"
    how = "The least quality that is enough, 4 where paths are nearer than the cache" if name == "povray" else budget
    chosen = "" if name == "povray" else f"--engine {name} "
    noise = "The references have noise of their own."
    truth = "the library's own reference where it has one, else " if name == "povray" else ""
    if name == "cycles":
        noise = ("Behind ± is the standard error of Cycles' mean, as the spread of its 16 batches says; the references "
                 "have noise of their own.")
    (ROOT / "reports" / "published" / f"{name}.md").write_text(
        f"# {NAMES[name]} on the scene library\n\n```sh\nreference/measure_library.py build/release/bin/photonproof "
        f"{chosen}--keep out/{name} --update --size {options.size} --{budget}\n```\n\n"
        f"{how}, one thread: the mean against {truth}`path` (`bdpt` where mirrors or narrow holes hide the light, "
        "`ptracer` for `ball-lens`, `volpath` where there are media), ssim, relmse and seconds of processor time, at the size that the last column "
        f"says. {noise} {PAIRS[name]} In brackets the cause, where one is needed.\n\n"
        f"| scene | mean | ssim | relmse | s | {BUDGET[name]} | pixels across |\n|---|--:|--:|--:|--:|--:|--:|\n" + "\n".join(rows) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--engine", choices=list(NAMES), default="povray")
    parser.add_argument("--keep", type=pathlib.Path, required=True)
    parser.add_argument("--size", type=int, default=96)
    parser.add_argument("--quality", type=int, default=2)
    parser.add_argument("--spp", type=int, default=1024)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--pairs", type=int, default=16)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("scenes", nargs="*")
    options = parser.parse_intermixed_args()
    if options.pairs < FEWEST_PAIRS:
        parser.error(f"--pairs must be at least {FEWEST_PAIRS}, whose spread is the standard error")
    options.keep.mkdir(parents=True, exist_ok=True)
    scenes = options.scenes or sorted(path.parent.name for path in LIBRARY.glob("*/scene.xml"))
    for scene in scenes:
        found = measure(options.program, scene, options)
        if options.update:
            update_expect(scene, found, options)
        shown = found if isinstance(found, str) else {**found, "size": size_of(scene, options)[0]}
        print(table_row(scene, shown, options.engine), flush=True)
    if options.update:
        write_table(options)


if __name__ == "__main__":
    main()
