#!/usr/bin/env bash
#   harness/packaging/container.sh PACKAGES [BASE]
# Builds a container image from the Debian package of deb.sh, and tries it: pictures, demo and a gate by a user without
# rights. Prints times, and what the image adds to its base. Needs podman (Debian's package) and root or subuids.
# PACKAGES is the folder of the packages. BASE is an image, by default debian:12. The word "bare" makes a base by
# debootstrap, for machines that reach no registry; it needs root.
# Where a machine restricts containers, PODMAN is the program with options, such as "podman --runtime runc". PODMAN_RUN
# has options of its `run`, such as "--ulimit nofile=1024:1024".
# shellcheck disable=SC2086
set -euo pipefail
podman=${PODMAN:-podman}
here=$(cd "$(dirname "$0")" && pwd)
packages=$(realpath "$1")
base=${2:-debian:12}
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
if [ "$base" = bare ]; then
  base=localhost/bare-debian
  # A root of its own process, so that its mounts end with it.
  # shellcheck source=harness/setup/bare_debian.sh
  (source "$here/../setup/bare_debian.sh"; make_bare "$work/root" bookworm ca-certificates)
  tar -C "$work/root" --exclude=./proc/* --exclude=./dev/* -c . | $podman import --quiet - "$base" >/dev/null
  rm -rf "$work/root"
fi

# step NAME COMMAND...: prints the seconds and the last line of its output.
step() {
  local name=$1 begin end
  shift
  begin=$(date +%s.%N)
  "$@" >"$work/step.log" 2>&1 || { cat "$work/step.log"; echo "FAILED: $name"; exit 1; }
  end=$(date +%s.%N)
  printf '%-20s %7.1f s  %s\n' "$name" "$(echo "$end $begin" | awk '{print $1 - $2}')" "$(tail -n 1 "$work/step.log")"
}
megabytes() { $podman image inspect --format '{{.Size}}' "$1" | awk '{printf "%.0f", $1 / 1e6}'; }
run() { $podman run --rm --network none ${PODMAN_RUN:-} "$@"; }

step "build" $podman build --quiet --build-arg "BASE=$base" -t photonproof -f "$here/../ci/Containerfile" "$packages"
echo "size: $(($(megabytes photonproof) - $(megabytes "$base"))) MB over $base"
# shellcheck disable=SC2016
step "user" run --entrypoint sh photonproof -c '[ "$(id -u)" != 0 ] && id -un'
step "version" run photonproof --version
step "first picture" run photonproof render /usr/share/photonproof/scenes/library/cornell/scene.xml --spp 16 -o first.png
step "demo" run photonproof
mkdir "$work/gates" && chmod 777 "$work/gates"
step "init" run -v "$work/gates:/work" photonproof init ci -o ci
step "gate" run -v "$work/gates:/work" photonproof gate ci/gates.toml -o out
test -s "$work/gates/out/report.html"
