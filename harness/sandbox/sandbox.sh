#!/bin/sh
# Around one contained command, "$@" (sandbox_command.cpp): in a mount namespace of our own, so that what is mounted here
# ends with us. The last `stage` in the file status is where it failed.
set -eu
umask 022
cd "$SANDBOX"
say() { echo "$@" >>status; }
say stage prepare
if [ -n "$DISK" ]; then
  echo 1000 >/proc/self/oom_score_adj
  mount -t tmpfs -o "$DISK" photonproof disk
fi
mkdir disk/work disk/tmp disk/shm
say stage copy
[ -z "$STARTS_WITH" ] || cp -R --preserve=links,timestamps -- "$STARTS_WITH/." disk/work/ 2>errors
chmod -R u+rwX disk/work
[ -z "$OWNER" ] || chown -hR "$OWNER:$OWNER" disk

say stage run
status=0
begin=$(date +%s.%N)
(
  for group in $GROUPS_OF_LIMITS; do echo 0 >"$group/cgroup.procs" || exit 125; done
  [ -z "$DISK" ] || exec 9<filter
  [ -n "$DISK" ] || cd disk/work
  exec "$@"
) || status=$?
end=$(date +%s.%N)
say ended "$status" "$begin" "$end" "$(stat -f -c '%a %d' disk)"
[ "$status" = 0 ] && [ -n "$COLLECT" ] || exit "$status"

# Every process of the command is dead by now: nothing changes between a look and a copy.
say stage collect
if [ "$COLLECT" = . ]; then
  find disk/work \( -type b -o -type c -o -type p -o -type s \) -printf '%P\n' -delete >special
  cp -R --preserve=links,timestamps -- disk/work/. "$COLLECT_TO/" 2>errors
  chmod -R u+rwX,a+rX "$COLLECT_TO"
  say collected
elif kind=$(stat -c %F -- "disk/work/$COLLECT" 2>/dev/null); then
  say kind "$kind"
  case $kind in regular*)
    if [ "$(stat -c %s -- "disk/work/$COLLECT")" -le "$FILE_BYTES" ]; then
      cp -P -- "disk/work/$COLLECT" "$COLLECT_TO" 2>errors
      chmod u+rw,a+r -- "$COLLECT_TO"
      say collected
    else
      say too_large
    fi
    ;;
  esac
fi
say stage end
