# shellcheck shell=bash
# A bare Debian root for scripts to source: make_bare makes one, in_bare runs commands in it. Uses the package mirror of
# this machine. The folder is kept for inspection; remove it when done.

# make_bare FOLDER SUITE PACKAGES    (PACKAGES separated by commas)
make_bare() {
  local mirror=${MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -m1 -E 'debian|ubuntu')}
  bare=$1
  if [ ! -d "$bare/etc/apt" ]; then debootstrap --variant=minbase --include="$3" "$2" "$bare" "$mirror"; fi
  if [ -f /etc/resolv.conf ]; then cp -L /etc/resolv.conf "$bare/etc/resolv.conf"; fi
  mkdir -p "$bare/etc/apt/apt.conf.d"
  apt-config dump | grep -iE '^Acquire::(http|https)::proxy' >"$bare/etc/apt/apt.conf.d/90proxy" || true
  mount --bind "$bare" "$bare"  # containers need a root that is a mount point
  mount -t proc proc "$bare/proc"
  mount --rbind /dev "$bare/dev"
  trap 'umount -l "$bare/dev"; umount "$bare/proc"; umount -l "$bare"' EXIT
}

# in_bare COMMAND    a line of bash; BARE_ENV, "NAME=VALUE ...", is set for it
in_bare() {
  # shellcheck disable=SC2086
  env -i ${BARE_ENV:-} PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 chroot "$bare" bash -ec "$1"
}
