#!/usr/bin/env bash
# Tries the wheel of wheel.sh in a bare Debian root that has Python and no library of the build. Installs the wheel, makes
# a first picture, runs the program and the package's tests. Prints processor times. Needs root and debootstrap.
#   harness/packaging/try_wheel.sh ROOT WHEEL [SUITE]      ROOT is made, SUITE bookworm or another of the wheel's Python
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/bare_debian.sh
root=$1
wheel=$2
wheels=$(mktemp -d)
python3 -m pip download --quiet --disable-pip-version-check --only-binary :all: -d "$wheels" numpy pandas pytest
make_bare "$root" "${3:-bookworm}" python3,python3-venv
rm -rf "$root/tmp/wheels" "$root/tmp/tests" "$root/tmp/venv"
cp -r "$wheels" "$root/tmp/wheels"
cp "$wheel" "$root/tmp/wheels"
cp -r harness/python/tests "$root/tmp/tests"
rm -r "$wheels"

# step NAME COMMAND: prints its processor time and the last line of its output.
step() {
  in_bare "cd /tmp; TIMEFORMAT='%U %S'; { time { $2; } >/tmp/step.log 2>&1; } 2>/tmp/step.time" ||
    { cat "$root/tmp/step.log"; echo "FAILED: $1"; exit 1; }
  printf '%-28s %7.1f s  %s\n' "$1" "$(awk '{print $1 + $2}' "$root/tmp/step.time")" "$(tail -n 1 "$root/tmp/step.log")"
}
scene="/tmp/venv/lib/python3*/site-packages/photonproof/share/photonproof/scenes/library/cornell/scene.xml"  # expanded there
step "no library of the build" "! ls /usr/lib/x86_64-linux-gnu/ | grep -E 'embree|tbb|OpenEXR|cairo|X11'; echo none"
step "an empty environment" "python3 -m venv venv"
step "install" "venv/bin/pip install --no-index --find-links wheels photonproof"
step "first picture" "venv/bin/python -c 'import photonproof as p; p.write(\"first.png\", p.load(p.program.data() + \"/scenes/library/cornell/scene.xml\").render(spp=16).image)'; ls first.png"
step "the program" "venv/bin/photonproof render $scene --spp 4 -o first.exr"
step "demo" "venv/bin/photonproof demo"
step "gate" "rm -rf my-gates; venv/bin/photonproof init ci -o my-gates; venv/bin/photonproof gate my-gates/gates.toml -o my-gates/out"
step "install pytest, pandas" "venv/bin/pip install --no-index --find-links wheels pytest pandas"
step "the package's tests" "cd tests; ../venv/bin/python -B -m pytest -q -p no:cacheprovider"
step "remove" "venv/bin/pip uninstall -y photonproof; ! ls venv/lib/python3*/site-packages | grep photonproof; echo nothing is left"
