#!/usr/bin/env bash
# Proves that the autograder's archive runs where nothing but a bare Debian is: as Gradescope does, it is unpacked at
# /autograder/source, setup.sh is run, a submission is put at /autograder/submission, run_autograder is run.
#   sudo harness/setup/bare_autograder.sh PHOTONPROOF [FOLDER] [SUITE]    of the release that the program was built on
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
course=$here/../courses/photon-mapping
source "$here/bare_debian.sh"
folder=${2:-/var/tmp/photonproof-bare-autograder}
work=$(mktemp -d)
"$1" grade "$course/assignment.toml" --autograder "$work/autograder.zip"
"$course/make_submissions.sh" "$work/class" fast
make_bare "$folder" "${3:-bookworm}" ca-certificates,unzip
rm -rf "$folder/autograder"
mkdir -p "$folder/autograder/source" "$folder/autograder/results"
cp -r "$work/class/fast" "$folder/autograder/submission"
cp "$work/autograder.zip" "$folder/autograder/source"
rm -rf "$work"
in_bare 'cd /autograder/source && unzip -q autograder.zip && ./setup.sh >/autograder/setup.log 2>&1'
in_bare 'cd /autograder && source/run_autograder && cat results/results.json'
