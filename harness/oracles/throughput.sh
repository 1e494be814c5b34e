#!/bin/sh
# Compares the speed of `compare` with common tools on one 3840 x 2160 pair, in interleaved runs:
#
#   harness/oracles/throughput.sh [path of photonproof] [repetitions]
#
# - mse against OpenImageIO's idiff: whole processes, both read the same two EXR files.
# - ssim against scikit-image's structural_similarity, both on images in memory. scikit-image's are already displayed;
# ours (bin/bench/metrics_bench beside the program, which ./run --bench builds) are encoded first.
# - all metrics except hdr_flip: the whole process.
# Prints median seconds and ratios. A missing tool is named and left out (Debian: openimageio-tools, python3-skimage).
set -eu
here=$(dirname "$(readlink -f "$0")")
program=${1:-$here/../../build/release/bin/photonproof}
repetitions=${2:-5}
[ -x "$program" ] || { echo "throughput: no program at $program; build it by ./run, or name it" >&2; exit 1; }
python=/usr/bin/python3
"$python" -c 'import numpy' 2>/dev/null || { echo "throughput: needs python3-numpy to make the images" >&2; exit 1; }
exec "$python" "$here/throughput.py" "$program" "$repetitions"
