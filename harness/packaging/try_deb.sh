#!/usr/bin/env bash
# Tries the packages of deb.sh in a bare Debian root: installs them, makes a first picture, compares, gates, and removes
# them. Prints times and sizes. Needs root and debootstrap.
#   harness/packaging/try_deb.sh ROOT PACKAGES [SUITE]      ROOT is made, PACKAGES is their folder, SUITE bookworm or other
set -euo pipefail
source "$(dirname "$0")/../setup/bare_debian.sh"
root=$1
package=$(ls "$2"/photonproof_*.deb)
make_bare "$root" "${3:-bookworm}" ca-certificates
cp "$package" "$root/tmp/photonproof.deb"
cp "$2"/photonproof-formats_*.deb "$root/tmp/formats.deb"
printf 'P3 12 12 255 %0864d' 0 | sed 's/0/ 9/g' >"$root/tmp/grey.ppm"
scenes=/usr/share/photonproof/scenes/library

# step NAME COMMAND: prints the seconds and the last line of its output.
step() {
  local begin end
  begin=$(date +%s.%N)
  in_bare "cd /tmp && { $2; } >/tmp/step.log 2>&1" || { cat "$root/tmp/step.log"; echo "FAILED: $1"; exit 1; }
  end=$(date +%s.%N)
  printf '%-28s %7.1f s  %s\n' "$1" "$(echo "$end $begin" | awk '{print $1 - $2}')" "$(tail -n 1 "$root/tmp/step.log")"
}

before=$(du -sm --exclude=proc --exclude=dev "$root" | cut -f1)
step "install" "export DEBIAN_FRONTEND=noninteractive; apt-get update; apt-get install -y --no-install-recommends /tmp/photonproof.deb"
after=$(du -sm --exclude=proc --exclude=dev "$root" | cut -f1)
echo "size: package $(du -k "$package" | cut -f1) KB; with all libraries $((after - before)) MB"
step "first picture" "photonproof render $scenes/cornell/scene.xml --spp 16 -o first.png --quiet"
step "demo" "photonproof demo"
step "compare" "photonproof compare $scenes/cornell/reference-64x64.exr $scenes/cornell/reference-64x64.exr"
step "gate" "rm -rf my-gates; photonproof init ci -o my-gates; photonproof gate my-gates/gates.toml -o my-gates/out"
step "engines" "photonproof engines"
step "no PPM without formats" "! photonproof compare grey.ppm grey.ppm 2>&1"
step "completions and pages" "test -s /usr/share/man/man1/photonproof-render.1.gz; bash -c 'source /usr/share/bash-completion/completions/photonproof'"
step "install formats" "export DEBIAN_FRONTEND=noninteractive; apt-get install -y --no-install-recommends /tmp/formats.deb"
step "PPM" "photonproof compare grey.ppm grey.ppm"
step "remove" "apt-get purge -y photonproof photonproof-formats; test ! -e /usr/share/photonproof; test ! -e /usr/bin/photonproof; test ! -e /usr/lib/photonproof; echo nothing is left"
