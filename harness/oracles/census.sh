#!/usr/bin/env bash
# Counts which scene files load, and what keeps the others from it.
#   harness/oracles/census.sh [--program PROGRAM] [--names] FOLDER...
# Every .xml file whose root is <scene> is planned, not rendered. A file "lacks data" when all its errors are missing
# files. One line a kind of obstacle: files that have it, files that have it alone, the obstacle. With --names only the
# files that do not load.
set -euo pipefail
program=build/release/bin/photonproof
names=
while [ $# -gt 0 ]; do
  case $1 in
    --program)
      program=$2
      shift 2
      ;;
    --names)
      names=yes
      shift
      ;;
    *) break ;;
  esac
done
if [ $# -eq 0 ]; then
  echo "usage: $0 [--program PROGRAM] [--names] FOLDER..." >&2
  exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
find "$@" -name '*.xml' -type f -print0 | sort -z | while IFS= read -r -d '' file; do
  grep -q '<scene[ >]' -- "$file" || continue
  echo "FILE $file"
  if timeout 60 "$program" render "$file" --plan --allow-outside >"$work/plan" 2>"$work/errors"; then
    grep -q ': warning: ' "$work/errors" && echo "NOTES"
    echo "LOADS"
  else
    status=$?
    # "place: error: message, and at other places" becomes the message without what was expected instead.
    sed -nE 's/^.*: error: (.*)$/\1/p' "$work/errors" | sed -E 's/, and at .*//; s/ \(did you mean .*//; s/, expected .*//' |
      sort -u | sed 's/^/ERROR /'
    [ $status -eq 2 ] || echo "ERROR the program ended with $status"
  fi
done >"$work/results"
awk '
  function close_file(  text) {
    if (name == "") return
    files++
    if (loads) { loaded++; if (notes) noted++ }
    else if (errors > 0 && missing == errors) lacking++
    else refused++
    for (text in own) { having[text]++; if (errors == 1) alone[text]++ }
    if (!loads && names) print name
    delete own
    loads = notes = errors = missing = 0
  }
  /^FILE /  { close_file(); name = substr($0, 6) }
  /^LOADS/  { loads = 1 }
  /^NOTES/  { notes = 1 }
  /^ERROR / { errors++; text = substr($0, 7); if (text ~ /no such file|Git LFS/) { missing++; text = "a file is missing" } own[text] = 1 }
  END {
    close_file()
    if (names) exit
    printf "%d scenes: %d load (%d with stand-ins or other notes), %d lack data, %d are refused\n", files, loaded, noted, lacking, refused
    for (text in having) printf "%6d %6d  %s\n", having[text], alone[text], text | "sort -k1,1nr -k2,2nr -k3"
  }' names="$names" "$work/results"
