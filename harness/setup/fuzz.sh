#!/usr/bin/env bash
# Builds every fuzz target with clang's sanitizers, runs each for a while from its stored corpus, and fails on a find.
#   harness/setup/fuzz.sh [SECONDS_PER_TARGET] [TARGET...]     default: 600 s of each
#   harness/setup/fuzz.sh --merge [TARGET...]                  puts what new inputs reach into the stored corpora, smallest first
# Found inputs lie in build/fuzz/found/TARGET, new ones of no harm in build/fuzz/inputs/TARGET, where the next run goes on.
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/packages.sh
# shellcheck disable=SC2086,SC2154
install_packages $build_packages clang libclang-rt-14-dev

seconds=600 merge=
case ${1:-} in
  --merge) merge=1 && shift ;;
  [0-9]*) seconds=$1 && shift ;;
esac
quietly build/fuzz.configure.log cmake --preset fuzz -DPHOTONPROOF_UNITY=ON
quietly build/fuzz.build.log cmake --build build/fuzz --target fuzzers

export TMPDIR=${TMPDIR:-/dev/shm}
export ASAN_OPTIONS=${ASAN_OPTIONS:-allocator_may_return_null=1:detect_odr_violation=0}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}

# The last "cov: 1234 ft: 5678" of a log: edges, and edges told apart by how often they were met.
reached() { grep -o 'cov: [0-9]* ft: [0-9]*' "$1" | tail -n 1; }

finds=0
while read -r target corpus dictionary; do
  [ $# -eq 0 ] || [[ " $* " = *" $target "* ]] || continue
  inputs=build/fuzz/inputs/$target found=build/fuzz/found/$target log=build/fuzz/$target.log
  mkdir -p "$inputs" "$found"
  if [ -n "$merge" ]; then
    # Only what reaches something that no file of the corpus does, and only inputs that are small enough to be kept.
    before=$(find "$corpus" -type f | wc -l)
    "build/fuzz/bin/$target" -merge=1 -max_len=2048 "$corpus" "$inputs" >"$log" 2>&1
    echo "$target: $before inputs became $(find "$corpus" -type f | wc -l)"
    continue
  fi
  arguments=(-max_total_time="$seconds" -timeout=20 -rss_limit_mb=2560 -max_len=16384 -artifact_prefix="$found/" -print_final_stats=1)
  [ -z "$dictionary" ] || arguments+=(-dict="build/fuzz/$dictionary")
  if "build/fuzz/bin/$target" "${arguments[@]}" "$inputs" "$corpus" >"$log" 2>&1; then
    runs=$(grep -o 'number_of_executed_units: [0-9]*' "$log" | grep -o '[0-9]*$')
    echo "$target: nothing found in $runs runs and $seconds s, $(reached "$log")"
  else
    finds=$((finds + 1))
    echo "$target: found something, see $found and $log"
    grep -m 3 -E 'ERROR|SUMMARY|runtime error' "$log" || tail -n 3 "$log"
  fi
done <build/fuzz/fuzzers.txt
exit "$((finds > 0))"
