#!/usr/bin/env bash
# Builds every fuzz target with clang's sanitizers, runs each for a while from its stored corpus, and fails on a find.
#   harness/setup/fuzz.sh [SECONDS_PER_TARGET] [TARGET...]     default: 600 s each; counted in
#                                                              reports/published/fuzzing.md
#   harness/setup/fuzz.sh --quick [SECONDS] [TARGET...]        for CI: 6 s each from the stored corpus alone, always the
#                                                              same inputs; not counted
#   harness/setup/fuzz.sh --merge [TARGET...]                  adds inputs that reach new edges to the stored corpora,
#                                                              smallest first, and counts their edges
# Finds are in build/fuzz/found/TARGET. Other new inputs are in build/fuzz/inputs/TARGET, where the next run continues.
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/packages.sh

seconds=600 merge='' quick=''
case ${1:-} in
  --merge) merge=1 && shift ;;
  --quick) quick=1 seconds=6 && shift ;;
esac
case ${1:-} in [0-9]*) seconds=$1 && shift ;; esac
# shellcheck disable=SC2086,SC2154
install_packages $build_packages $fuzz_packages || [ -n "$quick" ]
if [ -n "$quick" ] && ! command -v clang++ >/dev/null; then
  echo "fuzzers: not run, there is no clang++ here"
  exit
fi
quietly build/fuzz.configure.log cmake --preset fuzz -DPHOTONPROOF_UNITY=ON
quietly build/fuzz.build.log cmake --build build/fuzz --target fuzzers

if [ -z "${TMPDIR:-}" ] && [ -w /dev/shm ]; then export TMPDIR=/dev/shm; fi
export ASAN_OPTIONS=${ASAN_OPTIONS:-allocator_may_return_null=1:detect_odr_violation=0}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
ledger=reports/published/fuzzing.md
slowest=20  # processor seconds that one input may take

# The last "cov: 1234 ft: 5678" of a log: the number of edges, and of edges with different hit counts.
reached() { grep -o 'cov: [0-9]* ft: [0-9]*' "$1" | tail -n 1; }
executed() { grep -o '^#[0-9][0-9]*' "$1" | tail -n 1 | tr -d '#'; }

# A checksum of the contents of these sources (prefixes of paths), without tests.
state_of() {
  local part
  for part in "$@"; do find "${part%/*}" -type f -path "$part*"; done | grep -E '\.(cpp|h|json)$' | grep -vE '_(test|bench)\.' |
    LC_ALL=C sort -u | xargs sha1sum | sha1sum | cut -c1-10
}

# libFuzzer times an input by the clock, so on a busy machine a harmless input seems to hang. It counts as slow only if
# it takes as much processor time when run alone.
is_slow_alone() { (ulimit -t "$slowest" && "build/fuzz/bin/$1" "$2") >/dev/null 2>&1 && return 1 || return 0; }

# fuzz TARGET CORPUS DICTIONARY: false on a find; output goes to $log. Sets `runs`, `processor` (processor seconds) and
# `interrupted` (by Ctrl-C, which is no find).
fuzz() {
  local target=$1 corpus=$2 dictionary=$3 end=$((SECONDS + seconds)) clean=1
  local inputs=build/fuzz/inputs/$target found=build/fuzz/found/$target artifact used
  local more=()
  if [ -n "$quick" ]; then
    inputs=build/fuzz/quick/$target more=(-seed=1)
    rm -rf "$inputs"
  fi
  mkdir -p "$inputs" "$found"
  : >"$log"
  runs=0 processor=0 interrupted=''
  while [ "$clean" = 1 ] && [ -z "$interrupted" ] && [ "$SECONDS" -lt "$end" ]; do
    local arguments=(-max_total_time=$((end - SECONDS)) -timeout=60 -report_slow_units=60 -rss_limit_mb=2560
      -max_len=16384 "-artifact_prefix=$found/" -reload=0 "${more[@]}")
    [ "$dictionary" = none ] || arguments+=(-dict="build/fuzz/$dictionary")
    clean=0
    TIMEFORMAT='%U %S'
    used=$({ time "build/fuzz/bin/$target" "${arguments[@]}" "$inputs" "$corpus" >"$log.part" 2>&1; } 2>&1) || clean=1
    clean=$((1 - clean))
    runs=$((runs + $(executed "$log.part" || echo 0)))
    processor=$(awk -v a="$processor" '{ print a + $1 + $2 }' <<<"$used")
    cat "$log.part" >>"$log"
    ! grep -q 'libFuzzer: run interrupted' "$log.part" || { interrupted=1 && clean=1; }
    [ "$clean" = 0 ] || break
    artifact=$(grep -o 'Test unit written to .*' "$log.part" | tail -n 1 | sed 's/Test unit written to //') || true
    case $artifact in
      */timeout-* | */slow-unit-*)
        is_slow_alone "$target" "$artifact" || { rm -f "$artifact" && clean=1; } ;;
    esac
  done
  rm -f "$log.part"
  [ "$clean" = 1 ]
}

# count TARGET CORPUS STATE MINUTES PROCESSOR_MINUTES RUNS EDGES FINDS: adds to the target's row if the sources are the
# same, else restarts it; EDGES may be empty.
count() {
  # shellcheck disable=SC2016
  [ -f "$ledger" ] || printf '%s\n' '# Fuzzing' '' \
    'Written by `harness/setup/fuzz.sh`, whose runs add up in a row as long as the sources that its target covers stay as' \
    'they are; `state` is a checksum of those. Edges are what the corpus and all that was tried have reached. Finds are of' \
    'all times, each fixed and an input of the corpus, which is an ordinary test.' '' \
    '| target | state | minutes | of the processor | executions | edges | corpus | finds |' \
    '|---|---|---|---|---|---|---|---|' >"$ledger"
  local files bytes
  files=$(find "$2" -type f | wc -l)
  bytes=$(find "$2" -type f -printf '%s\n' | awk '{ n += $1 } END { printf "%.0f", n / 1024 }')
  awk -F ' *[|] *' -v target="$1" -v state="$3" -v minutes="$4" -v processor="$5" -v runs="$6" -v edges="$7" \
    -v finds="$8" -v corpus="$files files, $bytes KB" '
    function row() {
      printf "| %s | %s | %.1f | %.2f | %d | %s | %s | %d |\n", target, state, minutes, processor, runs, edges, corpus, finds
    }
    $2 == target {
      finds += $9
      if ($3 == state) { minutes += $4; processor += $5; runs += $6; if ($7 > edges + 0) edges = $7 }
      row(); there = 1; next
    }
    { print }
    END { if (!there) row() }' "$ledger" >"$ledger.part"
  mv "$ledger.part" "$ledger"
}

finds=0
while read -r target archive dictionary covers; do
  [ $# -eq 0 ] || [[ " $* " = *" $target "* ]] || continue
  corpus=build/fuzz/corpora/$(basename "$archive" .tar.xz)
  log=build/fuzz/${quick:+quick/}$target.log
  # shellcheck disable=SC2086
  [ -n "$quick" ] || state=$(state_of $covers)
  if [ -n "$merge" ]; then
    # Adds only inputs that reach an edge that no file of the corpus reaches, and that are small enough to keep.
    before=$(find "$corpus" -type f | wc -l)
    mkdir -p "build/fuzz/inputs/$target"
    "build/fuzz/bin/$target" -merge=1 -use_counters=0 -max_len=4096 "$corpus" "build/fuzz/inputs/$target" >"$log" 2>&1
    find "$corpus" -type f -exec harness/setup/corpus.sh "$archive" {} +
    count "$target" "$corpus" "$state" 0 0 0 "" 0
    echo "$target: $before inputs became $(find "$corpus" -type f | wc -l)"
    continue
  fi
  began=$SECONDS found_one=0
  fuzz "$target" "$corpus" "$dictionary" || found_one=1
  if [ -z "$quick" ]; then
    count "$target" "$corpus" "$state" "$(awk "BEGIN { print ($SECONDS - $began) / 60 }")" \
      "$(awk "BEGIN { print $processor / 60 }")" "$runs" "$(reached "$log" | cut -d ' ' -f 2)" "$found_one"
  fi
  if [ "$found_one" = 0 ]; then
    echo "$target: nothing found in $runs runs and $((SECONDS - began)) s, $processor s of them the processor's, $(reached "$log")"
  else
    finds=$((finds + 1))
    echo "$target: found something, see build/fuzz/found/$target and $log"
    grep -m 3 -E 'ERROR|SUMMARY|runtime error' "$log" || tail -n 3 "$log"
  fi
  [ -z "$interrupted" ] || exit 130
done <build/fuzz/fuzzers.txt
exit "$((finds > 0))"
