#!/usr/bin/env bash
# Installs Mitsuba 3 for `photonproof mitsuba` into build/peers, a virtual environment of Python's packages. Safe to
# repeat. Download: 83 MB. Needs Python 3.11 on x86-64, as Debian 12 has it.
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/wheels.sh

folder=$PWD/build/peers
# The wheels of another Python or architecture have other hashes.
requirements="mitsuba==3.9.1 --hash=sha256:7ad4fca9aedd588e5851177c7510eb8b6d27b2a5d2ee614e443dfd1bf92d457f
drjit==1.5.0 --hash=sha256:0d9cb374fe1f05d4167a8c24cbce6084404372e5fb3dcd6f08bbb1cee06f245a
numpy==2.4.6 --hash=sha256:89cd468399cfd2504718f0ba50e410dca55a170b61a02ad92bb18c8a65186e93"

version() { "$folder/bin/python" -c 'import mitsuba; print("Mitsuba", mitsuba.__version__)' 2>/dev/null; }
if [ "$(version)" != "Mitsuba 3.9.1" ]; then
  install_wheels "mitsuba: it" "$folder" "$requirements" "Python 3.11 and python3-venv are needed"
fi
echo "$(version) in $folder"
