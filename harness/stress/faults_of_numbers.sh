#!/bin/sh
# Lists the sweeps that each fault of numbers breaks. The test NumericFaults checks a few faults on a few sweeps; this
# script runs all sweeps. It runs path and photon mapper at the wanted levels and, where nothing shows, at all levels
# below them. It prints what is worse than without a fault. Some minutes a fault.
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

# Each fault has its own program name, so that its kept results are not taken for another fault's.
with_fault() {
  command="$folder/program-$1"
  cat >"$command.part" <<END
#!/bin/sh
# $(cksum <"$program-faulty")
# Faulty kernels exist for one instruction set only.
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

# climb FAULT KIND OPTIONS...: runs the sweeps into FOLDER/FAULT-KIND; KIND is quick or full.
climb() {
  fault=$1 kind=$2
  shift 2
  "$program" stress "$@" --program "$(with_fault "$fault")" -o "$folder/$fault-$kind" >"$folder/$fault-$kind.txt" \
    2>/dev/null || true
}

# worse FAULT KIND OPTIONS...: prints what is worse than without a fault; false where nothing is.
worse() {
  [ -f "$folder/none-$2.txt" ] || (kind=$2 && shift 2 && climb none "$kind" "$@")
  against=$folder/none-$2/stress.json
  climb "$@" --against "$against"
  grep '^regression: ' "$folder/$1-$2.txt"
}

for fault in "$@"; do
  echo "== $fault"
  # Some faults do not show at the wanted levels but do at lower ones. An example is a step that is too long for a scene
  # of a thousandth of the size: it is right in one that is rescaled.
  worse "$fault" quick --quick || worse "$fault" full --engine path --engine photonmapper || echo "nothing is worse"
done
