#!/usr/bin/env bash
# Builds Debian packages of this checkout, for the system that it runs on: photonproof and libphotonproof-dev. Installs
# what is missing for the build. Prints the packages, which lie in build/packages.
#   harness/packaging/deb.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/packages.sh
# shellcheck disable=SC2086,SC2154
install_packages $build_packages $package_packages
tests=()
[ -f build/release/build.ninja ] || tests=(-DPHOTONPROOF_TESTS=OFF)
quietly build/configure.log cmake --preset release "${tests[@]}"
echo "building the program and its library"
quietly build/build.log cmake --build build/release --target package_files
rm -rf build/packages
quietly build/packages.log cpack --config build/release/CPackConfig.cmake -B build/packages
rm -rf build/packages/_CPack_Packages
ls -1 build/packages/*.deb
