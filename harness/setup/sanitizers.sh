#!/usr/bin/env bash
# Builds with sanitizers and runs under them. Fails if one of them reports anything in any process.
#   harness/setup/sanitizers.sh [--quick | --part K/N] [address] [thread]     default: both; address is address and
#                                                                            undefined behaviour
# --quick: builds only the program, renders a small scene by every integrator and mode, benchmarks, gates, compares and
# reports. Without it: every test of the suite. On two cores address takes 20 minutes to build and 45 to run, thread 20
# and 110.
# --part K/N: every Nth test from the Kth on. Parts 1/N to N/N together are the suite.
set -euo pipefail
cd "$(dirname "$0")/../.."
source harness/setup/packages.sh
quick='' part=''
case ${1:-} in
  --quick) quick=1 && shift ;;
  --part)
    if ! [[ ${2:-} =~ ^([1-9][0-9]*)/([1-9][0-9]*)$ ]] || [ "${BASH_REMATCH[1]}" -gt "${BASH_REMATCH[2]}" ]; then
      echo "--part takes K/N, such as 2/4, not '${2:-}'" >&2 && exit 2
    fi
    part=${BASH_REMATCH[1]},,${BASH_REMATCH[2]} && shift 2 ;;
esac
# shellcheck disable=SC2086,SC2154
install_packages $build_packages $sanitizer_packages
# shellcheck disable=SC2086,SC2154
[ -n "$quick" ] || install_packages $check_packages
kinds=("$@")
[ ${#kinds[@]} -gt 0 ] || kinds=(address thread)

# Sanitizers write to files, since the harness captures engines' output. A process with a report ends with a code that
# no verb has. The symbolizer is in the folder of those files.
watched() {
  local log=$1
  local common=exitcode=99:log_path=$log:external_symbolizer_path=${log%/*}/llvm-symbolizer
  shift
  ASAN_OPTIONS="$common:detect_odr_violation=0:allocator_may_return_null=1" \
    UBSAN_OPTIONS="$common:print_stacktrace=1:halt_on_error=1" \
    TSAN_OPTIONS="$common:report_thread_leaks=0:ignore_noninstrumented_modules=1:suppressions=$PWD/harness/setup/threads_suppressed.txt" "$@"
}

# Tests that do not work with address checks. The checks map terabytes, against limits of address space, and replace the
# malloc whose memory tests measure. They recurse with libfaketime, which is loaded before them. One test needs a kill
# after a finished cell: none of its eight came so late in a program this slow.
not_by_address='Escapes.fail/take_memory(_in_many_processes)? |what_does_not_fit_in_memory|needs_memory_for_a_band'
not_by_address+='|Soak.of_a_sound_program|Soak.within_one_process|Faults.of_every_kind|Faults.find_a_program_that_loses'
# The thread sanitizer maps and allocates as much and is 5 to 20 times as slow. Tests with time limits fail, and
# diagnoses of pictures by hundreds of renders take hours.
not_by_thread="$not_by_address|Faults.find|PlantedFaults.(index_of|caustic)|BenchVerb.killed_at_any_moment|Diagnosis|HiddenMistakes|StudentMistakes"

# Runs the program's main functions once, by every integrator and mode.
run_quickly() {
  local program=$1 folder=$2 log=$3
  # Soaks for one cycle, which gives no growth, so its exit code is 3.
  watched "$log" "$program-trials" soak --renders 1 -o "$folder/soak" || [ $? = 3 ]
  mkdir -p "$folder/faults"
  watched "$log" "$program-trials" faults --kills 4 --only "kill, bench" -o "$folder/faults"
  watched "$log" "$program" gate "$folder/faults/inputs/gates.toml" -o "$folder/gate" --fresh
  watched "$log" "$program" bench "$folder/faults/inputs/bench.toml" -o "$folder/bench"
  watched "$log" "$program" report "$folder/bench/results.json" --format markdown,csv,latex,junit,gbench,bencher
  watched "$log" "$program" grade "$folder/faults/inputs/course.toml" "$folder/faults/inputs/pupil" --no-sandbox \
    --no-timing -o "$folder/grade"
  watched "$log" "$program" compare "$folder/soak/images/texture-bitmap-path.exr" \
    "$folder/soak/images/texture-bitmap-bdpt.exr" --heatmaps "$folder"
  watched "$log" "$program" stress --quick --only "moved uv" -o "$folder/stress"
}

said_something=0
for kind in "${kinds[@]}"; do
  case $kind in address) preset=asan ;; thread) preset=tsan ;; *) echo "no sanitizer '$kind'" >&2 && exit 2 ;; esac
  quietly "build/$preset.configure.log" cmake --preset "$preset" -DPHOTONPROOF_UNITY=ON \
    -DPHOTONPROOF_TESTS="$([ -n "$quick" ] && echo OFF || echo ON)"
  quietly "build/$preset.build.log" cmake --build "build/$preset" ${quick:+--target photonproof_trials}
  runs=build/$preset/runs
  rm -rf "$runs"
  mkdir -p "$runs"
  log=$PWD/$runs/said
  # The symbolizer writes to standard error, also for suppressed reports, and tests read that. This one discards it.
  printf '#!/bin/sh\nexec llvm-symbolizer-19 "$@" 2>/dev/null\n' >"$runs/llvm-symbolizer"
  chmod +x "$runs/llvm-symbolizer"
  if [ -n "$quick" ]; then
    # A shell of its own keeps `set -e`, which an || on the function would switch off.
    set +e
    (set -e; run_quickly "build/$preset/bin/photonproof" "$runs" "$log")
    ended=$?
    set -e
    [ "$ended" = 0 ] || said_something=1
  else
    without=()
    [ "$kind" = address ] && without=(--exclude-regex "$not_by_address")
    [ "$kind" = thread ] && without=(--exclude-regex "$not_by_thread")
    watched "$log" ctest --test-dir "build/$preset" -j "$(nproc)" --timeout 3600 --output-on-failure "${without[@]}" \
      ${part:+-I "$part"} ||
      said_something=1
  fi
  for file in "$log".*; do
    [ -e "$file" ] || continue
    # Skips reports of a child without exec of a process with threads: the thread sanitizer ignores its accesses, so it
    # is no find.
    grep -vqE '^$|main thread finished with ignores enabled|^  One of the following ignores' "$file" || continue
    said_something=1
    echo "$file:"
    head -n 40 "$file"
  done
done
[ "$said_something" = 0 ] && echo "sanitizers: nothing"
exit "$said_something"
