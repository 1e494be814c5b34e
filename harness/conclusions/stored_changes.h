// What the stored numbers of two runs say about a change, where the old program cannot be run again. Sessions differ in
// how fast the machine was, so times are judged relative to the calibration beside each (calibration.h), and what is
// left of the difference widens the interval. Many answers are "inconclusive".
//
// What is left was measured on two shared virtual cores with 7 to 12 processes waiting: six sessions of one program,
// every second one with a load on memory beside it, two scenes by three engines, 8 seeds each, so 90 comparisons of a
// program with itself. Median processor times differed by 15 % in half of them and by up to 60 %; relative to the
// calibration, by 9 % and up to 27 %. Beyond what the seeds' scatter explains, 8 of the 90 had to be widened to call no
// change, by up to 23 %; relative to the calibration 1 had to, by 2.7 %. Three sessions of 20 seeds: 3 of 9 by up to 5
// %, and none. On another kind of processor nothing was measured, so no verdict is given there.
#pragma once

#include <vector>

#include "harness/conclusions/paired_rounds.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// Factors by which one program's processor time may differ between two sessions of one host, beyond its scatter within
/// them: without a calibration, and relative to it. The latter is twice what was seen, since few sessions were.
inline constexpr double between_sessions = 1.25;
inline constexpr double between_calibrated_sessions = 1.05;

/// For the scene, engine and budget of `cell`: a record of processor time, unless seconds are the budget, and one of
/// relmse where both runs have it for the same seeds against the same reference. Seeds serve as repetitions.
std::vector<ChangeRecord> stored_changes(const Results& old_run, const Results& new_run, const Cell& cell,
                                         const ChangeThresholds& thresholds);

}  // namespace photonproof::inline harness_conclusions
