#!/usr/bin/env bash
# Compares the scenes of old_scenes.py that do not load with the list of those that are known not to.
#   harness/oracles/old_scenes_test.sh PROGRAM FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$2"
python3 -B "$here/old_scenes.py" "$2"
diff <("$here/census.sh" --program "$1" --names "$2" | xargs -r -n1 basename) "$here/old_scenes_refused.txt" && exit 0
echo "the list above differs from $here/old_scenes_refused.txt: < does not load now, > did not load before" >&2
exit 1
