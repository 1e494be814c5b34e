#!/usr/bin/env bash
# Measures how often `photonproof bench --against` finds a slow-down of 3 %, and how often it finds one that does not
# exist. Sessions of both kinds alternate, each a run of its own. Prints one line per session, and the table in
# reports/published/against.md.
#   harness/power_of_against.sh [SESSIONS] [BUILD FOLDER]     default: 100 of each kind, build/release
set -euo pipefail
cd "$(dirname "$0")/.."
sessions=${1:-100}
build=$(realpath "${2:-build/release}")
cmake --build "$build" --target photonproof slow_down >/dev/null
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Uses copies, so that a simultaneous build cannot change the measured programs.
cp "$build/bin/photonproof" "$build/bin/slow_down" "$work/"
for kind in old:0 null:0 planted:0.03; do
  printf '#!/bin/sh\nexec "%s/slow_down" %s "%s/photonproof" "$@"\n' "$work" "${kind#*:}" "$work" >"$work/${kind%:*}"
  chmod +x "$work/${kind%:*}"
done
bench() {
  "$work/photonproof" bench harness/suites/power.toml -o "$work/out" --no-report "$@"
}
bench >/dev/null 2>&1

for ((session = 1; session <= sessions; ++session)); do
  for kind in null planted; do
    began=$(date +%s.%N)
    code=0
    words=$(bench --program "$work/$kind" --against "$work/out/results.json" --old-program "$work/old" 2>&1) || code=$?
    facts=$(sed -nE 's/.*processor time new\/old ([0-9.]+) .*interval ([0-9.]+) to ([0-9.]+)\), ([0-9]+) rounds/\1 \2 \3 \4/p' <<<"$words")
    case $code in 0) verdict=unchanged ;; 1) verdict=regression ;; 3) verdict=inconclusive ;; *) verdict=failed ;; esac
    # A session with an improvement exits with 0.
    if grep -q '% faster' <<<"$words"; then verdict=improvement; fi
    echo "$kind $verdict $facts $(echo "$(date +%s.%N) $began" | awk '{printf "%.1f", $1 - $2}')"
  done
done | tee "$work/sessions"

awk -v host="$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores" '
  { ++count[$1, $2]; ++all[$1]; sum[$1] += $3; squares[$1] += $3 * $3; rounds[$1] += $6; seconds[$1] += $7 }
  END {
    print "\n| session | sessions | regression | improvement | unchanged | inconclusive | failed | ratio, mean | sd | rounds | seconds |"
    print "|---|---|---|---|---|---|---|---|---|---|---|"
    for (i = 1; i <= 2; ++i) {
      k = i == 1 ? "null" : "planted"; n = all[k]; mean = sum[k] / n
      sd = 0
      if (n > 1) sd = sqrt((squares[k] - n * mean * mean) / (n - 1))
      printf("| %s | %d | %d | %d | %d | %d | %d | %.4f | %.4f | %.1f | %.1f |\n", i == 1 ? "null" : "planted 3 %", n,
        count[k, "regression"], count[k, "improvement"], count[k, "unchanged"], count[k, "inconclusive"],
        count[k, "failed"], mean, sd, rounds[k] / n, seconds[k] / n)
    }
    print "\n" host
  }' "$work/sessions"
