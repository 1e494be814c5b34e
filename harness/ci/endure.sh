#!/usr/bin/env bash
# Builds the program and its trials and runs them: a thousand renders in one folder, a thousand kills, every other
# fault.
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/packages.sh
# shellcheck disable=SC2086,SC2154
install_packages $build_packages faketime
[ -f build/release/build.ninja ] || quietly build/configure.log cmake --preset release -DPHOTONPROOF_TESTS=OFF
quietly build/build.log cmake --build build/release --target photonproof_trials
build/release/bin/photonproof-trials soak -o out/soak
build/release/bin/photonproof-trials faults -o out/faults
