#!/usr/bin/env bash
# Grades a small set of submissions again and again, under any load of the machine. Verdicts must be the same every
# time, and speeds too, or be "too noisy". Prints a table, and fails if two gradings differ without reporting it.
#   regrade_test.sh WORK PHOTONPROOF [TIMES [PRECISION]]     WORK is deleted and made anew; 20 times
# Two measured speed-ups differ silently if their points differ. They also do if they are more than 2 % apart and their
# intervals, which are written beside them, do not overlap. With a PRECISION such as 0.02, only speed-ups known that
# well are measured.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$1
photonproof=$2
times=${3:-20}
precision=${4:-}
rm -rf "$work"
mkdir -p "$work/course" "$work/graded"
cp -r "$here/scenes" "$here/staff" "$work/course"
"$here/make_submissions.sh" "$work/course/submissions" handout honest fast wrong-lost-energy
{
  sed '/^\[\[scene\]\]/,$d; s|^submission = "handout"|submission = "submissions/handout"|' "$here/assignment.toml"
  for scene in 1 3; do
    [ $scene = 1 ] && echo '[[scene]]' || echo '[[hidden]]'
    printf 'name = "%s"\npath = "scenes/course-%s.xml"\nscene_option = "-s%s"\nwidth = 32\nheight = 32\n' \
      $scene $scene $scene
  done
} | sed "s/^timed = .*/timed = [\"1\"]\nrounds = 5${precision:+\nprecision = $precision}/" >"$work/course/assignment.toml"
# Built once; every run is a new one.
for time in $(seq "$times"); do
  rm -rf "$work/grades/cells" "$work/grades/rounds"
  "$photonproof" grade "$work/course/assignment.toml" "$work"/course/submissions/* --resume -o "$work/grades" >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; exit 1; }
  cp "$work/grades/grades.json" "$work/graded/$time.json"
done
python3 -B "$here/regrades_table.py" "$work"/graded/*.json
