#!/usr/bin/env bash
# Compares the scenes of a generator that do not load with a list of known ones.
#   harness/oracles/known_refusals_test.sh PROGRAM GENERATOR FOLDER
# GENERATOR is old_scenes or new_scenes. The list is GENERATOR_refused.txt. Each line has a file and, after a space, the
# reason.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
list=$here/$2_refused.txt
rm -rf "$3"
python3 -B "$here/$2.py" "$3"
diff <("$here/census.sh" --program "$1" --names "$3" | xargs -r -n1 basename) <(cut -d' ' -f1 "$list") && exit 0
echo "the list above differs from $list: < does not load now, > did not load before" >&2
exit 1
