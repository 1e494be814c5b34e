#!/usr/bin/env bash
# Puts the example's submissions together, each a whole folder as a student hands it in.
#   make_submissions.sh FOLDER [NAME...]     FOLDER/NAME of all, or of those named; what was there of these is replaced
#   make_submissions.sh --defects FOLDER [NAME...]     the same of defects/, which are honest with one mistake each
#
# handout is the handed-out program, and honest is that with honest.patch. wrong-* and cheat-* are honest with their own
# patch. fast is its own files and those that it has kept. The files are the same every time, except the pictures in
# cheat-hard-coded-image, which fast renders here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
patches=submissions
if [ "${1:-}" = --defects ]; then
  patches=defects
  shift
fi
[ $# -ge 1 ] || { sed -n '2,4s/^# *//p' "$0" >&2; exit 2; }
folder=$1
shift

if [ $patches = defects ]; then
  all=()
  found=("$here"/defects/*.patch)
else
  all=(handout honest fast)
  found=("$here"/submissions/{wrong,cheat}-*.patch)
fi
for patch in "${found[@]}"; do all+=("$(basename "$patch" .patch)"); done
[ $# -gt 0 ] || set -- "${all[@]}"

apply() { # PATCH FOLDER
  if command -v patch >/dev/null; then
    patch --quiet --no-backup-if-mismatch -p1 -d "$2" <"$1"
  else
    (cd "$2" && GIT_DIR=/dev/null git apply "$1")
  fi
}

assemble() { # NAME FOLDER
  rm -rf "$2"
  mkdir -p "$2"
  case $1 in
    fast)
      for kept in image.cpp image.h main.cpp noise.cpp noise.h scene_file.cpp scenes.cpp vec.h config.h; do
        cp "$here/handout/$kept" "$2"
      done
      cp "$here"/submissions/fast/* "$2"
      ;;
    handout) cp "$here"/handout/* "$2" ;;
    *)
      cp "$here"/handout/* "$2"
      apply "$here/submissions/honest.patch" "$2"
      [ "$1" = honest ] || apply "$here/$patches/$1.patch" "$2"
      ;;
  esac
}

# Makes the pictures that a student with the public scenes' pictures could hand in.
render_pictures() { # FOLDER
  local work
  work=$(mktemp -d)
  assemble fast "$work/fast"
  cp "$here/staff/config.h" "$work/fast"
  make -s -j2 -C "$work/fast"
  mkdir "$1/pictures"
  for scene in 1 2; do "$work/fast/raytracer" "-s$scene" -w 64 -h 64 -o "$1/pictures/$scene.ppm"; done
  rm -rf "$work"
}

for name; do
  [[ " ${all[*]} " == *" $name "* ]] || { echo "there is no submission $name; there are: ${all[*]}" >&2; exit 2; }
  assemble "$name" "$folder/$name"
  [ "$name" != cheat-hard-coded-image ] || render_pictures "$folder/$name"
done
