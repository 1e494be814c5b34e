#!/usr/bin/env python3
"""Counts how often a sentence of `grade` is right on mistakes that diagnosis was never tuned on.

  measure.py WORK PHOTONPROOF [--mistakes FILE] [--config CONFIG_H] [--markdown FILE] [--resume]

Each mistake of FILE (mistakes.txt, which describes the format) is planted in the honest submission and graded on three
scenes of the course. A printed finding is right where "kind: sentence" matches the mistake's expression. "differs" claims
no cause and counts as not explained. CONFIG_H replaces the staff's parameters, for a reference that our renderer fits
less well. Only sources that a mistake changes are compiled, so a submission brings its program built.
"""
import argparse
import collections
import json
import math
import pathlib
import re
import shutil
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
COURSE = HERE.parent
SCENES = [("1", "scenes/course-1.xml", 'scene_option = "-s1"'), ("3", "scenes/course-3.xml", 'scene_option = "-s3"'),
          ("hanging", "scenes/hanging.xml", 'params_template = "scenes/scene.mustache"\n'
           'params_place = "input.scene"\nscene_option = "-finput.scene"')]
FLAGS = ["g++", "-std=c++14", "-O2"]


def read_mistakes(file):
    mistakes = []
    for line in file.read_text(encoding="utf-8").splitlines():
        if line.startswith("== "):
            name, right, words = line[3:].split(" ;; ")
            mistakes.append({"name": name, "right": re.compile(right), "words": words, "edits": [],
                             "set": "report" if len(mistakes) % 2 else "cut"})
        elif line and not line.startswith("#"):
            name, edit = line.split(": ", 1)
            old, new = edit.split(" =>", 1)
            mistakes[-1]["edits"].append((name, old, new.strip()))
    return mistakes


def build(folder, sources):
    for source in sources:
        subprocess.run([*FLAGS, "-c", source], cwd=folder, check=True)
    objects = sorted(o.name for o in folder.glob("*.o"))
    subprocess.run([*FLAGS, "-o", "raytracer", *objects], cwd=folder, check=True)


def plant(mistake, honest, folder):
    """A copy of the honest submission, built, whose Makefile has nothing left to do."""
    shutil.copytree(honest, folder)
    changed = {name for name, _, _ in mistake["edits"]}
    for name, old, new in mistake["edits"]:
        text = (folder / name).read_text()
        if old not in text:
            raise SystemExit(f"{mistake['name']}: {name} has no '{old}'")
        (folder / name).write_text(text.replace(old, new))
    if any(name.endswith(".h") for name in changed):
        changed = {p.name for p in folder.glob("*.cpp") if p.name != "unit_tests.cpp"}
    build(folder, sorted(changed))
    for built in folder.glob("*.o"):
        built.unlink()
    (folder / "Makefile").write_text("raytracer:\n\t@true\n")


def prepare(work, config, mistakes):
    course, submissions = work / "course", work / "course/submissions"
    submissions.mkdir(parents=True)
    shutil.copytree(COURSE / "scenes", course / "scenes")
    (course / "staff").mkdir()
    shutil.copy(config, course / "staff/config.h")
    subprocess.run([COURSE / "make_submissions.sh", work, "honest"], check=True)
    shutil.copy(config, work / "honest/config.h")
    build(work / "honest", sorted(p.name for p in (work / "honest").glob("*.cpp") if p.name != "unit_tests.cpp"))
    for mistake in [*mistakes, {"name": "honest", "edits": []}]:
        plant(mistake, work / "honest", submissions / mistake["name"])
    shutil.copytree(submissions / "honest", course / "honest")
    text = re.split(r"^\[\[scene\]\]", (COURSE / "assignment.toml").read_text(), flags=re.M)[0]
    text = text.replace('"handout"', '"honest"').replace('timed = ["1", "2"]', 'timed = ["1"]')
    for name, path, option in SCENES:
        text += f'[[scene]]\nname = "{name}"\npath = "{path}"\n{option}\nwidth = 48\nheight = 48\n'
    (course / "assignment.toml").write_text(text)


def interval(right, count):
    """Clopper and Pearson's 95 % interval of a share, by bisection of the binomial's tails."""
    def tail(p, least):
        return sum(math.comb(count, k) * p**k * (1 - p)**(count - k) for k in range(least, count + 1))

    def root(least, target):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if tail(middle, least) < target else (low, middle)
        return low
    return (root(right, 0.025) if right > 0 else 0.0), (root(right + 1, 0.975) if right < count else 1.0)


def share(right, count):
    if count == 0:
        return "none printed"
    low, high = interval(right, count)
    return f"{right} of {count}: {100 * right / count:.0f} % ({100 * low:.0f} to {100 * high:.0f} %)"


def judged(mistakes, grades):
    """A row for each scene of each mistake: its verdict, and its findings with whether they are right."""
    rows = []
    for mistake in mistakes:
        submission = next(s for s in grades["submissions"] if s["name"] == mistake["name"])
        for scene in submission["scenes"]:
            findings = [(f["kind"], f["sentence"], bool(mistake["right"].search(f"{f['kind']}: {f['sentence']}")))
                        for f in scene["findings"] if f["kind"] != "differs"]
            rows.append({"mistake": mistake, "scene": scene["scene"], "verdict": scene["verdict"],
                         "findings": findings})
    return rows


def summary(rows):
    lines = ["| mistakes | scenes | found wrong | explained | sentences right | first sentence right | mistakes whose "
             "sentences are all right |", "|---|---|---|---|---|---|---|"]
    for name in ("cut", "report"):
        own = [r for r in rows if r["mistake"]["set"] == name]
        found = [f for r in own for f in r["findings"]]
        first = [r["findings"][0] for r in own if r["findings"]]
        by_mistake = collections.defaultdict(list)
        for row in own:
            by_mistake[row["mistake"]["name"]] += [f[2] for f in row["findings"]]
        told = [m for m in by_mistake.values() if m]
        lines.append(f"| {len(by_mistake)} ({name}) | {len(own)} | {sum(r['verdict'] == 'wrong' for r in own)} | "
                     f"{len(first)} | {share(sum(f[2] for f in found), len(found))} | "
                     f"{share(sum(f[2] for f in first), len(first))} | {share(sum(all(m) for m in told), len(told))} |")
    return lines


def by_kind(rows):
    kinds = collections.defaultdict(lambda: {"cut": [0, 0], "report": [0, 0]})
    for row in rows:
        for kind, _, right in row["findings"]:
            kinds[kind][row["mistake"]["set"]][0] += right
            kinds[kind][row["mistake"]["set"]][1] += 1
    lines = ["| kind of sentence | cut: right | report: right |", "|---|---|---|"]
    for kind, count in sorted(kinds.items(), key=lambda item: -item[1]["cut"][1] - item[1]["report"][1]):
        lines.append(f"| {kind} | {share(*count['cut'])} | {share(*count['report'])} |")
    return lines


def details(rows):
    lines = ["| mistake | scene | verdict | printed |", "|---|---|---|---|"]
    for row in rows:
        printed = "; ".join(f"{'right' if right else 'wrong'}: {sentence}" for _, sentence, right in row["findings"])
        lines.append(f"| {row['mistake']['name']} ({row['mistake']['set']}) | {row['scene']} | {row['verdict']} | "
                     f"{printed or ('not explained' if row['verdict'] == 'wrong' else '')} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("photonproof", type=pathlib.Path)
    parser.add_argument("--mistakes", type=pathlib.Path, default=HERE / "mistakes.txt")
    parser.add_argument("--config", type=pathlib.Path, default=COURSE / "staff/config.h")
    parser.add_argument("--markdown", type=pathlib.Path)
    parser.add_argument("--resume", action="store_true", help="grade again what WORK has, from the images it has")
    given = parser.parse_args()
    work, mistakes = given.work.resolve(), read_mistakes(given.mistakes)
    if not given.resume:
        prepare(work, given.config, mistakes)
    subprocess.run([given.photonproof.resolve(), "grade", work / "course/assignment.toml",
                    *sorted((work / "course/submissions").iterdir()), "--no-timing", "-o", work / "grades",
                    *(["--resume"] if given.resume else [])], check=True, stdout=subprocess.DEVNULL)
    grades = json.loads((work / "grades/grades.json").read_text(encoding="utf-8"))
    nothing = {"name": "honest", "right": re.compile("^$"), "set": "honest"}
    rows = judged(mistakes, grades)
    honest = [f for row in judged([nothing], grades) for f in row["findings"]]
    text = "\n".join([*summary(rows), "", f"Sentences about the honest program: {len(honest)}.", "", *by_kind(rows), "",
                      *details(rows), ""])
    print(text)
    if given.markdown:
        given.markdown.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
