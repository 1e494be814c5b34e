#!/usr/bin/env python3
"""Renders small scenes, one parameter of docs/formats/scene.md each, by photonproof and by Mitsuba 3, and compares the pictures.

    PYTHON harness/oracles/mitsuba_parameters.py build/release/bin/photonproof -o out/mitsuba-parameters \\
        --markdown reports/published/mitsuba-parameters.md

PYTHON has the packages mitsuba and numpy. The variant is llvm_ad_rgb where LLVM is found (DRJIT_LIBLLVM_PATH may name it),
else scalar_rgb. Finished scenes are kept in the output folder under what they follow from (text, program, Mitsuba, samples);
a second run goes on after them. `--only REGEX` renders a part, `--list` prints names. nightly.sh runs it, coarsely.

Each program renders a scene with several seeds, so that the standard errors come from independent images; samples double
until the mean is known to --error percent or --most samples are reached. A line of the table has
  image   the channel whose mean differs most: ours / Mitsuba's, its standard error
  block   the same of the worst of 8 x 6 blocks, in terms of the block's own mean or a twentieth of the image's,
          whichever is larger, with the probability to meet so much or more among 48 blocks and 3 channels by chance
Scenes where Mitsuba is known to be wrong are in a second table. There our image must be the closed form within --tolerance,
where the scene has one, and our image with --as-mitsuba must be Mitsuba's, where that follows it.

A scene "differs" when its image is more than --tolerance percent off, or a block more than that, beyond chance (.0005).
"""
import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import re
import subprocess
import sys
import time
import zlib
from pathlib import Path

import numpy as np

import mitsuba_departures
import mitsuba_ellipsoid_scenes
import mitsuba_parameter_scenes as scenes
import mitsuba_scene_parts

SEEDS = 8
BLOCKS = (6, 8)  # rows, columns
CHANCE = 5e-4    # for one scene: of 300 right scenes, one in seven tables has a false alarm


# ---- rendering --------------------------------------------------------------------------------------------------------

def load_mitsuba(variant):
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        found = sorted(Path("/usr/lib").glob("*/libLLVM*.so*"))
        if found:
            os.environ["DRJIT_LIBLLVM_PATH"] = str(found[-1])
    import mitsuba
    mitsuba.set_variant(variant)
    try:
        mitsuba.Float(1) + 1
        import drjit
        drjit.eval(mitsuba.Float(1) + mitsuba.Float(2))
    except Exception:
        mitsuba.set_variant("scalar_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    return mitsuba


class Mitsuba:
    def __init__(self, variant):
        self.mi = load_mitsuba(variant)
        self.version = f"{self.mi.__version__} {self.mi.variant()}"

    def images(self, path, spp, first_seed):
        loaded = self.mi.load_file(str(path))
        return [np.array(self.mi.render(loaded, spp=spp, seed=first_seed + k))[..., :3].astype(float)
                for k in range(SEEDS)]

    def read(self, path):
        """The colour of an EXR that has other layers, too."""
        layers = dict(self.mi.Bitmap(str(path)).split())
        return np.array(layers["<root>"].convert(self.mi.Bitmap.PixelFormat.RGB, self.mi.Struct.Type.Float32,
                                                 False)).astype(float)


class Photonproof:
    def __init__(self, program, reader, options=()):
        self.program, self.reader, self.options = Path(program).resolve(), reader, list(options)
        self.version = hashlib.sha256(self.program.read_bytes()).hexdigest()[:16] + " ".join(self.options)

    def images(self, path, spp, first_seed):
        out = path.with_suffix(".exr")
        images = []
        for k in range(SEEDS):
            run = subprocess.run([self.program, "render", path, "-o", out, "--spp", str(spp), "--seed",
                                  str(first_seed + k), "--quiet", "--checkpoint", "0", *self.options], capture_output=True, text=True)
            if run.returncode:
                raise RuntimeError(run.stderr.strip().splitlines()[0] if run.stderr.strip() else f"exit {run.returncode}")
            images.append(self.reader(out))
        for left in (out, out.with_suffix(".stats.json")):
            left.unlink(missing_ok=True)
        return images


# ---- comparing ----------------------------------------------------------------------------------------------------------

def block_means(image):
    down, across = (min(n, pixels) for n, pixels in zip(BLOCKS, image.shape))
    rows = np.array_split(image, down, axis=0)
    return np.array([[cell.mean(axis=(0, 1)) for cell in np.array_split(row, across, axis=1)] for row in rows])


def student_tail(t, degrees):
    """Two-sided, by Simpson's rule over the angle whose tangent is t / sqrt(degrees)."""
    limit = math.atan(abs(t) / math.sqrt(degrees))
    steps = 400
    width = (math.pi / 2 - limit) / steps
    total = sum((1 if k in (0, steps) else 4 if k % 2 else 2) * max(math.cos(limit + k * width), 0)**(degrees - 1)
                for k in range(steps + 1)) * width / 3
    whole = math.sqrt(math.pi) * math.gamma(degrees / 2) / math.gamma((degrees + 1) / 2)
    return min(1.0, 2 * total / whole)


def compare(ours, theirs):
    """The record of two lists of images."""
    if ours[0].shape != theirs[0].shape:
        return {"problem": f"{ours[0].shape[1]}x{ours[0].shape[0]} pixels here, {theirs[0].shape[1]}x{theirs[0].shape[0]} there"}
    a, b = np.array([block_means(i) for i in ours]), np.array([block_means(i) for i in theirs])
    mean_a, mean_b = np.array([i.mean(axis=(0, 1)) for i in ours]), np.array([i.mean(axis=(0, 1)) for i in theirs])
    image = mean_b.mean(axis=0)
    scale = np.maximum(image, 1e-2 * image.max() if image.max() > 0 else 1e-6)
    difference = (mean_a.mean(axis=0) - image) / scale
    error = np.sqrt((mean_a.var(axis=0, ddof=1) + mean_b.var(axis=0, ddof=1)) / len(ours)) / scale
    worst = int(np.argmax(np.abs(difference)))
    block_scale = np.maximum(b.mean(axis=0), 0.05 * scale)
    block_difference = (a.mean(axis=0) - b.mean(axis=0)) / block_scale
    block_error = np.sqrt((a.var(axis=0, ddof=1) + b.var(axis=0, ddof=1)) / len(ours)) / block_scale
    # Where no sample of either program varies, a block is compared to single precision.
    block_error = np.maximum(block_error, 2e-6)
    t = np.abs(block_difference) / block_error
    where = np.unravel_index(int(np.argmax(t)), t.shape)
    tests = t.size
    own_error = np.sqrt(mean_a.var(axis=0, ddof=1) / len(ours))
    return {"own_error": own_error.tolist(), "ours": mean_a.mean(axis=0).tolist(), "theirs": image.tolist(), "channel": "RGB"[worst],
            "ratio": 1 + float(difference[worst]), "error": float(error[worst]), "errors": float(error.max()),
            "block": [int(where[1]), int(where[0])], "block_channel": "RGB"[int(where[2])],
            "block_ratio": 1 + float(block_difference[where]), "block_error": float(block_error[where]),
            "block_chance": min(1.0, tests * student_tail(float(t[where]), 2 * len(ours) - 2))}


def verdict(record, tolerance):
    if "problem" in record:
        return "refused" if record["problem"].startswith(("Mitsuba: ", "photonproof: ")) else "differs"
    off, error = abs(record["ratio"] - 1), record["error"]
    if off > tolerance and student_tail(off / max(error, 1e-7), 2 * SEEDS - 2) < CHANCE:
        return "differs"
    if abs(record["block_ratio"] - 1) > tolerance and record["block_chance"] < CHANCE:
        return "differs"
    return "equal" if off + error <= tolerance else "noisy"


# ---- running ------------------------------------------------------------------------------------------------------------

def pooled(images):
    """SEEDS images, each the mean of one of every round with the weight of its samples."""
    total = sum(spp for spp, _ in images)
    return [sum(spp * batch[k] for spp, batch in images) / total for k in range(SEEDS)]


def render_case(case, index, arguments, mitsuba, photonproof, pool):
    folder = arguments.output
    ours_path, theirs_path = folder / f"scene-{index:03d}.xml", folder / f"scene-{index:03d}-mitsuba.xml"
    if arguments.folder:
        ours_path = theirs_path = arguments.folder / f"{case.name}.xml"
    else:
        ours_path.write_text(case.text)
        theirs_path.write_text(case.twin or case.text)
    spp, rounds_ours, rounds_theirs = arguments.spp, [], []
    seed = zlib.crc32(case.name.encode()) % 10**6  # so that scenes have different noise
    if "width" not in case.text:  # the default film has 144 times the pixels of the others
        spp = 4
    most, most_at_once = arguments.most, arguments.most
    if '"width" value="1"' in case.text:  # as many samples as an image of the others' size
        # Mitsuba adds samples in single precision: images of 2 million in a pixel are off by 0.1 % and more.
        most, most_at_once = 3072 * most, 32768
        spp = min(3072 * spp, most_at_once)
    while True:
        promise = pool.submit(photonproof.images, ours_path, spp, seed)
        problem = ""
        try:
            theirs = mitsuba.images(theirs_path, spp, seed)
        except Exception as refusal:  # Mitsuba throws RuntimeError and others
            problem = "Mitsuba: " + " ".join(str(refusal).split())[-160:]
        try:
            ours = promise.result()
        except Exception as refusal:
            problem = "photonproof: " + str(refusal).replace(str(folder), ".")
        if problem:
            return {"problem": problem}
        rounds_ours.append((spp, ours))
        rounds_theirs.append((spp, theirs))
        record = compare(pooled(rounds_ours), pooled(rounds_theirs))
        record["spp"] = sum(s for s, _ in rounds_ours) * SEEDS
        if "problem" in record or record["errors"] <= arguments.error / 100 or record["spp"] >= most:
            return record
        seed += SEEDS
        spp = min(2 * spp, most_at_once, max(1, (most - record["spp"]) // SEEDS))


def key_of(case, arguments, mitsuba, photonproof):
    text = "\0".join((case.text, case.twin, mitsuba.version, photonproof.version, str(arguments.spp), str(arguments.most),
                      str(arguments.error)))
    return hashlib.sha256(text.encode()).hexdigest()


def run(cases, arguments, mitsuba, photonproof, title=""):
    folder = arguments.output
    folder.mkdir(parents=True, exist_ok=True)
    if not arguments.folder:
        mitsuba_scene_parts.write_files(folder)
        mitsuba_departures.write_files(folder)
        mitsuba_ellipsoid_scenes.write_files(folder)
    kept_file = folder / "records.json"
    kept = json.loads(kept_file.read_text()) if kept_file.exists() else {}
    records, begun = {}, time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        for index, case in enumerate(cases):
            key = key_of(case, arguments, mitsuba, photonproof)
            if key not in kept:
                kept[key] = render_case(case, index, arguments, mitsuba, photonproof, pool)
                partial = kept_file.with_suffix(".partial")
                partial.write_text(json.dumps(kept))
                partial.replace(kept_file)
            records[case.name] = kept[key]
            said = verdict(kept[key], arguments.tolerance / 100)
            print(f"{index + 1:4d}/{len(cases)} {time.monotonic() - begun:5.0f} s  {case.name + title:44s} {said:8s} "
                  f"{shown(kept[key])}", flush=True)
    return records


# ---- the table ------------------------------------------------------------------------------------------------------------

def shown(record):
    if "problem" in record:
        return record["problem"]
    return (f"{record['channel']} {record['ratio']:.5f} ± {record['error']:.5f}, block {record['block_channel']} "
            f"{record['block_ratio']:.4f} ± {record['block_error']:.4f} p {record['block_chance']:.2g}")


def parameters_of_format(page):
    """(kind, plugin, parameter) of every row of the tables in docs/formats/scene.md that is no extension."""
    kind, plugin, rows, earlier, extension = "", "", set(), {}, False
    for line in page.splitlines():
        heading = re.match(r"### (\w+)$", line)
        cells = [c.strip() for c in line.split("|")[1:-1]]
        if heading:
            kind, earlier = heading[1], {}
        elif line.startswith("## ") and kind:
            break
        elif kind and len(cells) == 5 and re.match(r"`\w+`$", cells[0]):
            plugin, extension = cells[0].strip("`"), cells[4].startswith("extension")
            names = re.findall(r"(?<!nested )`(\w+)`", cells[1])
            rows |= {(kind, plugin, n) for n in ["", *names] if not extension}
        elif kind and len(cells) == 5 and not cells[0] and re.match(r"`\w+`$", cells[1]):
            if not extension and not cells[4].startswith("extension"):
                rows.add((kind, plugin, cells[1].strip("`")))
    return rows


def parameters_of_scenes(cases):
    import xml.etree.ElementTree as tree
    found = set()
    for case in cases:
        for node in tree.fromstring(case.text).iter():
            kind = node.get("type")
            if kind:
                found |= {(node.tag, kind, "")} | {(node.tag, kind, child.get("name", "")) for child in node}
    return found


def table(cases, records, arguments, mitsuba):
    lines, count = [], {"equal": 0, "differs": 0, "noisy": 0, "ours is right": 0, "refused": 0}
    for case in cases:
        record = records[case.name]
        said = verdict(record, arguments.tolerance / 100)
        if case.why and said == "differs":
            said = "ours is right"
        count[said] += 1
        if "problem" in record:
            lines.append(f"| {case.name} | | | {said} | {record['problem']} |")
            continue
        lines.append(f"| {case.name} | {record['channel']} {record['ratio']:.5f} ± {record['error']:.5f} | "
                     f"{record['block_channel']} {record['block_ratio']:.4f} ± {record['block_error']:.4f} | {said} | "
                     f"{case.why if said == 'ours is right' else ''} |")
    summary = (f"{len(cases)} scenes{'' if arguments.folder else ' of 64 x 48 or 64 x 64 pixels'}: {count['equal']} equal within {arguments.tolerance} %, "
               f"{count['noisy']} too noisy to tell, {count['ours is right']} differ and ours is right, {count['differs']} "
               f"differ{', %d are refused by a program' % count['refused'] if count['refused'] else ''}.")
    page = arguments.markdown.name if arguments.markdown else "mitsuba-parameters.md"
    only = f' --only "{arguments.only}"' if arguments.only else ""
    head = f"""# Parameters against Mitsuba {mitsuba.version}

Printed by `harness/oracles/mitsuba_parameters.py`, which says how a line is measured:

```sh
PYTHON harness/oracles/mitsuba_parameters.py build/release/bin/photonproof -o out/mitsuba-parameters \\
    --markdown reports/published/{page} --most {arguments.most} --error {arguments.error}{only}
```

{summary}

`image` is the ratio of the two images' means, ours to Mitsuba's, in the channel that differs most, ± its standard error.
`worst block` is the same of that of 48 blocks which is most standard errors off. A scene is too noisy to tell where its ratio
and error together leave the tolerance, but not beyond chance.

| scene | image | worst block | verdict | |
| --- | --- | --- | --- | --- |
"""
    return head + "\n".join(lines) + "\n", summary


def mean_is_right(case, record, tolerance):
    """Whether our mean is the closed form."""
    if not case.closed_form or "problem" in record:
        return not case.closed_form
    off = abs(record["ours"][1] / case.closed_form - 1)
    return off <= tolerance or student_tail(off * case.closed_form / max(record["own_error"][1], 1e-7), SEEDS - 1) >= CHANCE


def departure_table(cases, records, followed, tolerance):
    """The second table, and the names of scenes where it is not as it should be."""
    lines, bad = [], []
    for case in cases:
        if not case.followed or "problem" in records[case.name]:
            continue
        record, other = records[case.name], followed[case.name]
        said = verdict(other, tolerance)
        right = mean_is_right(case, record, tolerance)
        if said == "differs" or not right:
            bad.append(case.name + ("" if right else ": not the closed form") + (
                " (--as-mitsuba)" if said == "differs" else ""))
        form = f"{case.closed_form:.5f}" if case.closed_form else ""
        ratio = other.get("problem") or f"{other['ratio']:.5f} ± {other['error']:.5f}"
        lines.append(f"| {case.name} | {form} | {record['ours'][1]:.5f} ± {record['own_error'][1]:.5f} | "
                     f"{record['theirs'][1]:.5f} | {ratio} | {said} | {case.why} |")
    head = """
## Where Mitsuba departs

`closed form`, `ours` and `Mitsuba` are the mean of green. `as Mitsuba` is the ratio of the means of our image with `--as-mitsuba`
to Mitsuba's, in the channel that differs most.

| scene | closed form | ours | Mitsuba | as Mitsuba | | proof |
| --- | --- | --- | --- | --- | --- | --- |
"""
    return (head + "\n".join(lines) + "\n" if lines else ""), bad


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", help="the photonproof program")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/mitsuba-parameters"))
    parser.add_argument("--markdown", type=Path, help="the table, when every scene was rendered")
    parser.add_argument("--only", default="", metavar="REGEX", help="scenes whose names match")
    parser.add_argument("--folder", type=Path, help="in place of these scenes those of a folder")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba")
    parser.add_argument("--list", action="store_true", help="print names and what no scene covers")
    parser.add_argument("--spp", type=int, default=16, help="samples a pixel of each of the first 8 images")
    parser.add_argument("--most", type=int, default=1024, help="samples a pixel in all")
    parser.add_argument("--error", type=float, default=0.08, help="standard error of the mean to reach, percent")
    parser.add_argument("--tolerance", type=float, default=0.2, help="percent")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    cases = [scenes.Case(path.stem, path.read_text()) for path in sorted(arguments.folder.glob("*.xml"))
             ] if arguments.folder else scenes.all_cases()
    if arguments.list:
        page = (Path(__file__).resolve().parents[2] / "docs/formats/scene.md").read_text()
        print("\n".join(case.name for case in cases))
        for row in sorted(parameters_of_format(page) - parameters_of_scenes(cases)):
            print("no scene:", " ".join(row), file=sys.stderr)
        return 0
    chosen = [case for case in cases if re.search(arguments.only, case.name)]
    arguments.output = arguments.output.resolve()
    mitsuba = Mitsuba(arguments.variant)
    records = run(chosen, arguments, mitsuba, Photonproof(arguments.program, mitsuba.read))
    following = [case for case in chosen if case.followed]
    followed = run(following, arguments, mitsuba, Photonproof(arguments.program, mitsuba.read, ["--as-mitsuba"]), " as Mitsuba")
    text, summary = table(chosen, records, arguments, mitsuba)
    departed, unlike = departure_table(chosen, records, followed, arguments.tolerance / 100)
    print(summary)
    if arguments.markdown:
        arguments.markdown.write_text(text + departed)
    known = {case.name for case in chosen if case.why}
    wrong = ("differs",) if arguments.folder else ("differs", "refused")
    bad = [name for name, record in records.items()
           if verdict(record, arguments.tolerance / 100) in wrong and name not in known] + unlike
    if bad:
        print("differ: " + "; ".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
