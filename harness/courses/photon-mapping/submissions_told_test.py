"""Is what the grader says of the example's submissions what it must say (submissions/expected.txt)?

    submissions_told_test.py GRADES.json [NAME]     all, which must be those that were graded, or one
"""
import json
import pathlib
import re
import sys

grades = {s["name"]: s for s in json.load(open(sys.argv[1], encoding="utf-8"))["submissions"]}
lines = (pathlib.Path(__file__).parent / "submissions" / "expected.txt").read_text(encoding="utf-8").splitlines()
rows = [[field.strip() for field in re.split(r"(?<!\\)\|", line)] for line in lines if not line.startswith("#")]
problems = []
if len(sys.argv) > 2:
    rows = [row for row in rows if row[0] == sys.argv[2]]
elif sorted(row[0] for row in rows) != sorted(grades):
    problems.append("the names of expected.txt are not those of the submissions")
if not rows:
    problems.append("there is no such row")
for name, scenes, flags, sentence in rows:
    if name not in grades:
        problems.append(f"{name} was not graded")
        continue
    graded = grades[name]
    right = " ".join(s["scene"] for s in graded["scenes"] if s["verdict"] in ("right", "borderline"))
    kinds = " ".join(sorted({flag["kind"] for flag in graded["flags"]}))
    print(f"{name}: {graded['sentence']} [{kinds}], right on {right or 'none'}")
    if right != scenes:
        problems.append(f"{name} is right on '{right}', expected '{scenes}'")
    if kinds != flags:
        problems.append(f"{name} has the flags '{kinds}', expected '{flags}'")
    if not re.search(sentence.replace("\\|", "|"), graded["sentence"]):
        problems.append(f"{name}: what is said does not match '{sentence}'")
sys.exit("\n".join(problems) if problems else 0)
