#!/bin/sh
# Which ladders does each fault of numbers break, of all there are? The test NumericFaults holds a few of them to a few
# climbs; this climbs everything, by path and photon mapper at the heights that are wanted and, where nothing shows, at
# all below them, and prints what is worse than without a fault. Some minutes a fault.
#   harness/stress/faults_of_numbers.sh PHOTONPROOF FOLDER [FAULT...]
# needs photonproof-faulty beside PHOTONPROOF: cmake --build --preset release --target photonproof_faulty
set -eu
if [ $# -lt 2 ]; then
  sed -n '2,6s/^# //p' "$0"
  exit 2
fi
program=$(realpath "$1")
folder=$2
shift 2
[ -x "$program-faulty" ] || { echo "$0: there is no $program-faulty" >&2; exit 2; }
[ $# -gt 0 ] || set -- no-recentring no-rescaling float-faces float-sphere float-cylinder lost-height far-periods \
  fixed-step unclamped-metal
mkdir -p "$folder"

# Under one name for each fault, so that what is kept of one is not taken for another's.
with_fault() {
  command="$folder/program-$1"
  cat >"$command.part" <<END
#!/bin/sh
# $(cksum <"$program-faulty")
# Faults of kernels are in those of one instruction set.
case " \$* " in
  *" --integrator path "* | *" --integrator photonmapper "* | *" --integrator direct "*)
    [ "\$(uname -m)" != x86_64 ] || set -- "\$@" --isa v2 ;;
esac
PHOTONPROOF_FAULT=${1#none} exec $program-faulty "\$@"
END
  chmod +x "$command.part"
  mv "$command.part" "$command"
  realpath "$command"
}

# climb FAULT KIND OPTIONS...: to FOLDER/FAULT-KIND; KIND is quick or full.
climb() {
  fault=$1 kind=$2
  shift 2
  "$program" stress "$@" --program "$(with_fault "$fault")" -o "$folder/$fault-$kind" >"$folder/$fault-$kind.txt" \
    2>/dev/null || true
}

# worse FAULT KIND OPTIONS...: what is worse than without a fault; false where nothing is.
worse() {
  [ -f "$folder/none-$2.txt" ] || (kind=$2 && shift 2 && climb none "$kind" "$@")
  against=$folder/none-$2/stress.json
  climb "$@" --against "$against"
  grep '^step back' "$folder/$1-$2.txt"
}

for fault in "$@"; do
  echo "== $fault"
  # At the heights that are wanted a fault may not show, though it does below them: a step that is too long for a scene of a
  # thousandth of the size is none in one that is rescaled.
  worse "$fault" quick --quick || worse "$fault" full --engine path --engine photonmapper || echo "nothing is worse"
done
