#!/usr/bin/env bash
# Tests that the autograder's archive runs on a bare Debian. As Gradescope does, it unpacks the archive at
# /autograder/source and runs setup.sh. Then it puts a submission at /autograder/submission and runs run_autograder.
#   sudo harness/setup/bare_autograder.sh PHOTONPROOF [FOLDER] [SUITE]    SUITE: the release the program was built on
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
