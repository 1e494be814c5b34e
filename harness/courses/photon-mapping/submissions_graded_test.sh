#!/usr/bin/env bash
# Grades the example's submissions in small pictures of the public scenes and of the third. Then
# submissions_told_test.py checks the sentences about each.
#   submissions_graded_test.sh WORK PHOTONPROOF [OPTION...]     WORK is made anew; options of `photonproof grade`
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$1
photonproof=$2
shift 2
rm -rf "$work"
mkdir -p "$work/course/submissions"
cp -r "$here/scenes" "$here/staff" "$work/course"
"$here/make_submissions.sh" "$work/course" honest
"$here/make_submissions.sh" "$work/course/submissions"
# Compiles all sources at once, in a third of the time. If two of them define a macro, those that include config.h and
# the others are compiled apart.
cat >"$work/build.toml" <<'END'
command = ["sh", "-c", '''
  compile() ( sed 's/.*/#include "&"/' | g++ -std=c++17 -O1 -pthread -pedantic-errors -fmax-errors=1 -I. -x c++ "$@" - )
  sources=$(ls ./*.cpp | grep -v unit_tests)
  echo "$sources" | compile -o raytracer ||
    ( grep -l '"config.h"' $sources | compile -c -o with_config.o &&
      grep -L '"config.h"' $sources | compile -c -o others.o && g++ -pthread -o raytracer with_config.o others.o )''']
END
{
  sed -e '/^\[\[scene\]\]/,$d; s/"handout"/"honest"/' -e "/^command = \[\"make\"/{r $work/build.toml
d}" "$here/assignment.toml"
  printf '[[scene]]\nname = "1"\npath = "scenes/course-1.xml"\nscene_option = "-s1"\nwidth = 64\nheight = 64\n'
  printf '[[hidden]]\nname = "3"\npath = "scenes/course-3.xml"\nscene_option = "-s3"\nwidth = 48\nheight = 48\n'
  sed -n '/cube, a diffuse ball/,/^height/p' "$here/assignment.toml"
} | sed 's/timed = \["1", "2"\]/timed = ["1"]/' >"$work/course/assignment.toml"
"$photonproof" grade "$work/course/assignment.toml" "$work"/course/submissions/* --no-timing -o "$work/grades" "$@" >"$work/log" 2>&1 ||
  { cat "$work/log" >&2; exit 1; }
