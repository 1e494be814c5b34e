#!/usr/bin/env bash
# Installs Open Image Denoise for `photonproof render --denoise` into build/denoiser, from the Python package that
# bundles its libraries, and prints the line to set. Safe to repeat. Download: 88 MB.
#   eval "$(harness/setup/denoiser.sh)"
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/wheels.sh

# The wheel of another architecture has another hash; there the system's own package is needed.
package=pyoidn==2.5.1.0
hash=sha256:32ad13368f8de1ef63001942ad05b02a00cd732d1206d97f352d3a3f606d823e
folder=$PWD/build/denoiser

find_library() { find "$folder" -name libOpenImageDenoise.so.2 -print -quit 2>/dev/null; }
if [ -z "$(find_library)" ]; then
  install_wheels "denoiser: $package" "$folder" "$package --hash=$hash" "python3-venv is needed"
fi
library=$(find_library)
printf 'export PHOTONPROOF_OIDN=%q\n' "${library%/*}"
