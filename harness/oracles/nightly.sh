#!/usr/bin/env bash
# Checks `compare`, the renderer and the tests' tables against other people's programs; exits with 1 if they disagree.
#
#   harness/oracles/nightly.sh [PROGRAM [OPTIONS of nightly.py]]      PROGRAM: default build/release/bin/photonproof
#
# The other programs are packages of Python's index with versions pinned by requirements.txt, in an environment of their
# own in build/. nightly.py lists the comparisons.
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
