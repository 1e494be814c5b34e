#!/usr/bin/env bash
# Installs Open Image Denoise for `photonproof render --denoise` into build/denoiser, from the Python package that
# bundles its libraries, and prints the line to set. Safe to repeat. Download: 88 MB.
#   eval "$(harness/setup/denoiser.sh)"
set -euo pipefail
cd "$(dirname "$0")/../.."

# The wheel of another architecture has another hash; there the system's own package is needed.
package=pyoidn==2.5.1.0
hash=sha256:32ad13368f8de1ef63001942ad05b02a00cd732d1206d97f352d3a3f606d823e
folder=$PWD/build/denoiser

find_library() { find "$folder" -name libOpenImageDenoise.so.2 -print -quit 2>/dev/null; }
if [ -z "$(find_library)" ]; then
  mkdir -p "$folder"
  {
    python3 -m venv "$folder"
    echo "$package --hash=$hash" >"$folder/requirements.txt"
    "$folder/bin/python" -m pip install --no-deps --only-binary :all: --require-hashes -r "$folder/requirements.txt"
  } >"$folder/install.log" 2>&1 || {
    tail -n 15 "$folder/install.log" >&2
    echo "denoiser: $package could not be installed, see $folder/install.log (python3-venv is needed)" >&2
    exit 1
  }
fi
library=$(find_library)
printf 'export PHOTONPROOF_OIDN=%q\n' "${library%/*}"
