#!/usr/bin/env bash
# Gates a foreign renderer: the healthy one with several seeds, and each planted fault once. Exit code 77 where the
# renderer is not installed.
#   check.sh PHOTONPROOF ball|mitsuba|blender [SEEDS]
set -u
photonproof=$(realpath "$1") name=$2 seeds=${3:-20}
here=$(cd "$(dirname "$0")" && pwd)
case $name in
  ball) ;;
  mitsuba) python3 -c 'import mitsuba' 2>/dev/null || { echo "skipped: python3 cannot import mitsuba"; exit 77; } ;;
  blender) python3 -c 'import bpy' 2>/dev/null || { echo "skipped: python3 cannot import bpy"; exit 77; } ;;
esac
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
find "$here" -maxdepth 1 -type f -exec cp {} "$work" \; && cd "$work" || exit 2
export PHOTONPROOF_CACHE=$work/cache
[ "$name" != ball ] || ${CXX:-g++} -O2 -o ball ball.cpp || exit 2
engine=$(sed -n '/^\[\[engine\]\]/,/^name/s/^name = "\(.*\)"/\1/p' "$name.toml")
"$photonproof" reference "$name.toml" --engine "$engine" --budget spp=256 --quiet || exit 2

passed=0 problems=0
for ((seed = 1; seed <= seeds; ++seed)); do
  if "$photonproof" gate "$name.toml" --seed "$seed" --no-report -o out >out.txt 2>&1; then
    passed=$((passed + 1))
  else
    cat out.txt
  fi
done
echo "healthy: $passed of $seeds seeds pass"
[ "$passed" = "$seeds" ] || problems=1
while IFS=$'\t' read -r fault words; do
  sed "s/\"none\"/\"$fault\"/" "$name.toml" >"$name-$fault.toml"
  "$photonproof" gate "$name-$fault.toml" --no-report -o "out-$fault" >out.txt 2>&1
  code=$?
  sentence=$(grep -m 1 '^\[1/1\]' out.txt | sed 's/^[^:]*: //')
  printf '%-11s %s\n' "$fault" "${sentence:0:140}"
  [ $code = 1 ] && [[ $sentence =~ $words ]] && continue
  echo "PROBLEM: exit code $code; expected a failure with '$words'"
  cat out.txt
  problems=1
done <faults.txt
exit $problems
