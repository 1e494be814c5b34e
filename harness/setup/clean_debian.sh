#!/usr/bin/env bash
# Proves ./run and ./check on a bare Debian: debootstraps one, clones this repository into it, runs both there.
#   sudo harness/setup/clean_debian.sh [FOLDER] [SUITE] [COMMAND...]    e.g. /var/tmp/bare bookworm ./check
# Takes the package mirror of this machine. The folder is left for a look; remove it when done. The commands are ./run and
# ./check where none are given; BARE_ENV, "NAME=VALUE ...", is set for each.
set -euo pipefail
folder=${1:-/var/tmp/photonproof-bare}
suite=${2:-bookworm}
commands=("${@:3}")
[ ${#commands[@]} -gt 0 ] || commands=(./run ./check)
source=$(cd "$(dirname "$0")/../.." && pwd)
mirror=${MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -m1 -E 'debian|ubuntu')}

if [ ! -d "$folder/etc/apt" ]; then
  debootstrap --variant=minbase --include=ca-certificates,git "$suite" "$folder" "$mirror"
fi
[ -f /etc/resolv.conf ] && cp -L /etc/resolv.conf "$folder/etc/resolv.conf"
mkdir -p "$folder/etc/apt/apt.conf.d"
apt-config dump | grep -iE '^Acquire::(http|https)::proxy' >"$folder/etc/apt/apt.conf.d/90proxy" || true
rm -rf "$folder/photonproof"
git clone -q "file://$source" "$folder/photonproof"
mount -t proc proc "$folder/proc"
mount --rbind /dev "$folder/dev"
trap 'umount "$folder/proc"; umount -l "$folder/dev"' EXIT
# shellcheck disable=SC2086
in_bare() { env -i ${BARE_ENV:-} PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 chroot "$folder" bash -ec "cd /photonproof && $1"; }
for command in "${commands[@]}"; do time in_bare "time $command"; done
