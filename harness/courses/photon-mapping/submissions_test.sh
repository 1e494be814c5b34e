#!/usr/bin/env bash
# The example's submissions are the same every time, the handout passes its own tests, honest renders the same as the
# handout, and fast renders at all.
#   submissions_test.sh WORK     WORK is deleted and made anew
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$1
rm -rf "$work"
mkdir -p "$work"

names=(handout honest fast)
for patch in "$here"/submissions/{wrong,cheat}-*.patch; do
  name=$(basename "$patch" .patch)
  [ "$name" = cheat-hard-coded-image ] || names+=("$name")  # it renders pictures
done
"$here/make_submissions.sh" "$work/once" "${names[@]}"
"$here/make_submissions.sh" "$work/twice" "${names[@]}"
diff -r "$work/once" "$work/twice"
for name in "${names[@]:3}"; do
  if diff -rq "$work/once/honest" "$work/once/$name" >/dev/null; then echo "$name is honest" >&2; exit 1; fi
done
if "$here/make_submissions.sh" "$work/once" nobody 2>/dev/null; then echo "nobody is a submission" >&2; exit 1; fi

# Few photons and rays, to save time. The Makefile of the handout is honest's, too; make_submissions.sh uses fast's.
for name in handout honest fast; do
  sed -E 's/(GLOBAL_PHOTONS|CAUSTIC_PHOTONS|CAUSTIC_PHOTONS_WATER) [0-9]+/\1 300/; s/(GATHER_[A-Z]+) [0-9]+/\1 5/' \
    "$here/staff/config.h" >"$work/once/$name/config.h"
done
flags=(-std=c++17 -O1 -ffp-contract=off -pthread)
for name in honest fast; do # all sources at once, in a third of the time
  (cd "$work/once/$name" && rm -f unit_tests.cpp && printf '#include "%s"\n' ./*.cpp |
    g++ "${flags[@]}" -I. -x c++ -o raytracer -)
done
make -s -j2 -C "$work/once/handout" CXXFLAGS="${flags[*]}" raytracer test
for scene in 1 2 3; do
  for name in handout honest fast; do
    "$work/once/$name/raytracer" "-s$scene" -w 20 -h 12 -o "$work/$name-$scene.bmp" --seed 3 --threads 2
    [ "$(stat -c %s "$work/$name-$scene.bmp")" = $((54 + 60 * 12)) ]
  done
  cmp "$work/handout-$scene.bmp" "$work/honest-$scene.bmp"
done
"$work/once/handout/raytracer" -s1 -w 20 -h 12 -o "$work/other.bmp" --seed 4
if cmp -s "$work/handout-1.bmp" "$work/other.bmp"; then echo "the handout does not heed its seed" >&2; exit 1; fi
rm -rf "$work"
