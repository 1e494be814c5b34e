#!/usr/bin/env bash
# Grades three times ten mistakes that students make. The first sentence about each must be what a teaching assistant
# would say (defects/expected*.txt). Small pictures of two scenes.
#   defects_test.sh WORK PHOTONPROOF     WORK is deleted and made anew
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$1
photonproof=$2
rm -rf "$work"
mkdir -p "$work/course/submissions"
cp -r "$here/scenes" "$here/staff" "$work/course"
"$here/make_submissions.sh" "$work/course" honest
"$here/make_submissions.sh" --defects "$work/course/submissions"
{
  sed '/^\[\[scene\]\]/,$d; s/"handout"/"honest"/' "$here/assignment.toml"
  for scene in 1 3; do
    printf '[[scene]]\nname = "%s"\npath = "scenes/course-%s.xml"\nscene_option = "-s%s"\nwidth = 48\nheight = 48\n' \
      $scene $scene $scene
  done
} | sed 's/timed = \["1", "2"\]/timed = ["1"]/' >"$work/course/assignment.toml"
"$photonproof" grade "$work/course/assignment.toml" "$work"/course/submissions/* --no-timing -o "$work/grades" >"$work/log" ||
  { cat "$work/log" >&2; exit 1; }

python3 -B - "$work/grades/grades.json" "$here"/defects/expected*.txt <<'PYTHON'
import json, pathlib, re, sys
grades = {s["name"]: s for s in json.load(open(sys.argv[1]))["submissions"]}
missed = []
for file in sys.argv[2:]:
    lines = pathlib.Path(file).read_text(encoding="utf-8").splitlines()
    rows = [[field.strip() for field in re.split(r"(?<!\\)\|", line)] for line in lines if not line.startswith("#")]
    told = 0
    for name, scene, pattern, sentence, *untold in rows:
        row = next(s for s in grades[name]["scenes"] if s["scene"] == scene)
        findings = row["findings"]
        first = findings[0]["sentence"] if findings else row["sentence"]
        # What the student reads first names the scene that shows it most.
        named = grades[name]["sentence"] if grades[name]["sentence"].startswith("scene ") else ""
        said = [text for text in (first if findings else "", named) if re.search(pattern.replace("\\|", "|"), text, re.I)]
        told += bool(said)
        print(f"{'told' if said else 'not told':9}{name}: {said[0] if said else first or row['verdict']}")
        for finding in findings[1:]:
            print(f"{'':9}  then: {finding['sentence']}")
        if not said and not untold:
            missed.append(name)
    print(f"{told} of {len(rows)} told ({pathlib.Path(file).name})")
sys.exit(f"not told: {' '.join(missed)}" if missed else 0)
PYTHON
