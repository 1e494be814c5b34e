#!/usr/bin/env bash
# Holds `compare`, the renderer and the tables that tests read against other people's programs; exit 1 where they disagree.
#
#   harness/oracles/nightly.sh [PROGRAM [OPTIONS of nightly.py]]      PROGRAM: default build/release/bin/photonproof
#
# The other programs are packages of Python's index, whose versions requirements.txt pins, in an environment of their own below
# build/. nightly.py says what is held against what.
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${1:-build/release/bin/photonproof}
[ $# -eq 0 ] || shift
[ -x "$program" ] || { echo "nightly: no program at $program; build it by ./run, or name it" >&2; exit 2; }
environment=build/oracles
if ! python3 -c 'import ensurepip' 2>/dev/null; then
  source harness/setup/packages.sh
  install_packages python3-venv
fi
[ -x "$environment/bin/pip" ] || python3 -m venv "$environment"
"$environment/bin/pip" install --quiet --disable-pip-version-check --requirement harness/oracles/requirements.txt
exec "$environment/bin/python" harness/oracles/nightly.py "$program" "$@"
