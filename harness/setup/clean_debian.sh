#!/usr/bin/env bash
# Tests ./run and ./check on a bare Debian: debootstraps one, clones this repository into it, runs both there.
#   sudo harness/setup/clean_debian.sh [FOLDER] [SUITE] [COMMAND...]    e.g. /var/tmp/bare bookworm ./check
# The default commands are ./run and ./check. BARE_ENV, "NAME=VALUE ...", is set for each command.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/bare_debian.sh"
folder=${1:-/var/tmp/photonproof-bare}
commands=("${@:3}")
[ ${#commands[@]} -gt 0 ] || commands=(./run ./check)
make_bare "$folder" "${2:-bookworm}" ca-certificates,git
rm -rf "$folder/photonproof"
git clone -q "file://$(cd "$here/../.." && pwd)" "$folder/photonproof"
for command in "${commands[@]}"; do time in_bare "cd /photonproof && time $command"; done
