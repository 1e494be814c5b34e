#!/usr/bin/env bash
# A CI job in plain shell, for any service: installs missing packages (Debian or Ubuntu), builds if necessary, gates.
#   harness/ci/gate.sh [SUITE.toml [FOLDER [gate options]]]    default: harness/suites/gates.toml, out/gate
# FOLDER receives results.json, report.html and junit.xml. The exit code is that of `photonproof gate`: 0 pass, 1 fail,
# 2 usage or configuration, 3 inconclusive. To let an inconclusive run pass: harness/ci/gate.sh ... || [ $? -eq 3 ]
# Passes are kept in ~/.cache/photonproof/verdicts (or $PHOTONPROOF_CACHE/verdicts). If that folder outlives the job,
# gates with unchanged images pass at once.
set -euo pipefail
here=$(cd "$(dirname "$0")/../.." && pwd)
program=${PHOTONPROOF_PROGRAM:-$here/build/release/bin/photonproof}
suite=${1:-$here/harness/suites/gates.toml}
folder=${2:-out/gate}

build() {
  cd "$here"
  # shellcheck source=harness/setup/packages.sh
  source harness/setup/packages.sh
  # shellcheck disable=SC2086,SC2154
  install_packages $build_packages
  quietly build/configure.log cmake --preset release -DPHOTONPROOF_TESTS=OFF
  quietly build/build.log cmake --build build/release --target photonproof
}

# A failure before the gates run says nothing about them, so it counts as configuration (2). (A shell of its own keeps
# `set -e`, which an || on the function would switch off.)
if [ ! -x "$program" ]; then
  set +e
  (set -e; build)
  built=$?
  set -e
  [ "$built" -eq 0 ] || exit 2
fi

exec "$program" gate "$suite" -o "$folder" "${@:3}"
