"""Runs every oracle of this folder and says where one disagrees; nightly.sh is what one runs.

  nightly.py PROGRAM [--only REGEX] [--scenes REGEX]

- Tables of numbers that tests read are printed again by the scripts that made them: other methods, or Mitsuba itself.
- Constants that tests hold are looked for in those tests, number by number.
- `compare` and the tables of its metrics are held against scikit-image and flip-evaluator.
- Radiance fields are rendered by their definition in numpy.
- Small scenes, a parameter of docs/formats/scene.md each, are rendered beside Mitsuba (mitsuba_parameters.py).

--only chooses checks by name, --scenes those that Mitsuba renders. Exit codes: 0 all agree, 1 some do not.
"""
import argparse
import csv
import json
import re
import subprocess
import sys
from pathlib import Path

import flip_evaluator
import numpy as np
from skimage.metrics import mean_squared_error, peak_signal_noise_ratio, structural_similarity

import image_pairs

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d*)?(?:e[+-]?\d+)?(?![\w.])|(?<![\w.])[+-]?\.\d+")

# Scripts that print the numbers of a file of the tree.
TABLES = [
    (["bsdfs.py"], "harness/oracles/bsdfs_expected.tsv", 2e-6),
    (["ms_ssim_oracle.py"], "harness/oracles/ms_ssim_expected.csv", 1e-9),
    (["sky_oracle.py", "sky"], "scenes/sky/sky_hosek_wilkie_table.cpp", 0),
    (["sky_oracle.py", "sun"], "scenes/sky/sun_irradiance_table.cpp", 0),
]
# Scripts whose printed numbers all occur in one of the files.
CONSTANTS = [
    (["charts.py"], ["renderer/integrators/chart_scenes_test.cpp"]),
    (["mapped_normals.py"], ["renderer/scene/mapped_normals_test.cpp"]),
    (["tilted_floor.py"], ["renderer/integrators/tilted_floor_test.cpp"]),
    (["sun_position_oracle.py"], ["scenes/description/sun_position_test.cpp"]),
    (["sky_oracle.py", "expected"], ["renderer/light_sampling/sky_test.cpp", "scenes/description/sun_position_test.cpp"]),
]
# Scripts that render by another method, hold the program against it and end with 0 where they agree.
METHODS = ["radiance_field.py"]
# Scripts that hold themselves against Mitsuba and end with 0 where they agree.
PROOFS = ["principled.py"]
# FLIP's own program computes in single precision.
FLIP_TOLERANCE = 2e-5


def printed(command):
    script = [sys.executable, str(FOLDER / command[0]), *command[1:]]
    return subprocess.run(script, check=True, capture_output=True, text=True, cwd=ROOT).stdout


def numbers_of(text):
    """As they are written; the digits after a thousand's separator or within a name are none."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return NUMBER.findall(re.sub(r"(?<=\d)f\b", "", "\n".join(lines)))


def check_table(command, file, tolerance):
    ours, theirs = numbers_of((ROOT / file).read_text()), numbers_of(printed(command))
    if len(ours) != len(theirs):
        return [f"{file} has {len(ours)} numbers, {' '.join(command)} prints {len(theirs)}"]
    return [f"{file} has {a}, {' '.join(command)} prints {b}" for a, b in zip(ours, theirs)
            if abs(float(a) - float(b)) > tolerance * max(abs(float(b)), 1)]


def check_constants(command, files):
    known = np.array(sorted({float(n) for file in files for n in numbers_of((ROOT / file).read_text())}))
    problems = []
    for number in numbers_of(printed(command)):
        place = number.lstrip("+-").split("e")[0].partition(".")[2]
        last_digit = 10.0**-len(place) * 10.0**int((number.split("e") + ["0"])[1]) if place else 0
        if np.abs(known - float(number)).min() > 1.5 * last_digit:
            problems.append(f"{' '.join(command)} prints {number}, which is not in {' or '.join(files)}")
    return problems


def check_proof(script):
    run = subprocess.run([sys.executable, str(FOLDER / script)], capture_output=True, text=True, cwd=ROOT)
    return [] if run.returncode == 0 else run.stderr.splitlines()[-1:]


def check_method(script, program):
    run = subprocess.run([sys.executable, str(FOLDER / script), program], capture_output=True, text=True, cwd=ROOT)
    return [] if run.returncode == 0 else run.stdout.splitlines() + run.stderr.splitlines()[-1:]


def judged_by_packages(reference, test, exposure):
    """The metrics of a pair by scikit-image and flip-evaluator, with how far ours may be off."""
    linear = [image_pairs.read(file) for file in (reference, test)]
    shown = [image_pairs.display(image, exposure) for image in linear]
    ssim = structural_similarity(*shown, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1,
                                 channel_axis=2)
    single = [np.clip(image * 2.0**exposure, 0, 1).astype(np.float32) for image in linear]
    flip = flip_evaluator.evaluate(*single, "LDR", inputsRGB=False, applyMagma=False)[1]
    # Clamped as in the paper.
    single = [np.clip(image, 0, 65536).astype(np.float32) for image in linear]
    _, hdr_flip, settings = flip_evaluator.evaluate(*single, "HDR", applyMagma=False)
    mse = mean_squared_error(*linear)
    return {"ssim": (ssim, 1e-7), "psnr": (peak_signal_noise_ratio(*shown, data_range=1), 1e-5), "mse": (mse, 1e-6 * mse),
            "flip": (flip, FLIP_TOLERANCE), "hdr_flip": (hdr_flip, FLIP_TOLERANCE),
            # FLIP's median of an even number of pixels is one of the two in the middle, ours is their mean.
            "start": (settings["startExposure"], 1e-4), "stop": (settings["stopExposure"], 2e-3),
            "count": (settings["numExposures"], 0)}


def check_metrics(program):
    problems, tables = [], {}
    for file in ("ssim_expected.csv", "flip_expected.csv", "hdr_flip_expected.csv"):
        rows = [line for line in (FOLDER / file).read_text().splitlines() if not line.startswith("#")]
        for row in csv.DictReader(rows):
            tables.setdefault(row["pair"], {}).update(row)
    for name, reference, test, exposure in image_pairs.PAIRS:
        command = [program, "compare", *(str(FOLDER / "images" / file) for file in (reference, test)), "--json",
                   f"--exposure={exposure}", "--metrics=mse,psnr,ssim,flip,hdr_flip"]
        run = subprocess.run(command, capture_output=True, text=True)
        ours = {metric["name"]: metric["value"] for metric in json.loads(run.stdout)["metrics"]}
        for metric, (theirs, tolerance) in judged_by_packages(reference, test, exposure).items():
            for where, value in (("compare", ours.get(metric)), ("the tests' table", tables[name].get(metric))):
                if value is not None and abs(float(value) - theirs) > tolerance:
                    problems.append(f"{metric} of {name}: {value} by {where}, {theirs} by the package")
    return problems


def check_mitsuba(program, scenes):
    # Coarser than reports/published/mitsuba-parameters.md, which takes longer.
    command = [sys.executable, str(FOLDER / "mitsuba_parameters.py"), program, "-o", str(ROOT / "out/nightly-mitsuba"),
               "--most=64", "--error=0.5", "--tolerance=1", "--only", scenes]
    run = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    return [] if run.returncode == 0 else run.stdout.splitlines()[-1:] + run.stderr.splitlines()[-1:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", default="")
    parser.add_argument("--scenes", default="")
    arguments = parser.parse_args()
    program = str(Path(arguments.program).resolve())
    checks = {"compare by scikit-image and flip-evaluator": lambda: check_metrics(program)}
    for command, file, tolerance in TABLES:
        checks[" ".join(command)] = lambda row=(command, file, tolerance): check_table(*row)
    for command, files in CONSTANTS:
        checks[" ".join(command)] = lambda row=(command, files): check_constants(*row)
    for script in METHODS:
        checks[script] = lambda script=script: check_method(script, program)
    for script in PROOFS:
        checks[script] = lambda script=script: check_proof(script)
    checks["mitsuba_parameters.py"] = lambda: check_mitsuba(program, arguments.scenes)
    failed = 0
    for name in filter(lambda name: re.search(arguments.only, name), checks):
        problems = checks[name]()
        failed += bool(problems)
        print(f"{name}: {'agrees' if not problems else f'{len(problems)} disagreements'}", flush=True)
        for problem in problems[:10]:
            print(f"  {problem}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
