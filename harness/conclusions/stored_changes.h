// Compares the stored numbers of two runs, where the old program cannot run again. Sessions differ in the machine's
// speed. So times are divided by the calibration beside each (calibration.h), and the interval is widened by the rest
// of that difference. Many answers are "inconclusive".
//
// The rest was measured on two shared virtual cores with 7 to 12 processes waiting, in six sessions of one program.
// Every second one had a load on memory beside it. Two scenes by three engines with 8 seeds give 90 comparisons of a
// program with itself. Half of the median processor times differed by 15 % or more, the worst by 60 %. Relative to the
// calibration it was 9 % and 27 %. Beyond the seeds' scatter, 8 of the 90 intervals had to be widened by up to 23 % to
// call no change; relative to the calibration 1, by 2.7 %. With three sessions of 20 seeds it was 3 of 9, by up to 5 %,
// and none. Other kinds of processors were not measured, so there is no verdict between two kinds.
#pragma once

#include <vector>

#include "harness/conclusions/paired_rounds.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// Factors by which one program's processor time may differ between two sessions of one host, beyond its scatter within
/// them. The first is without a calibration, the second relative to it: twice what was measured, since sessions were
/// few.
inline constexpr double between_sessions = 1.25;
inline constexpr double between_calibrated_sessions = 1.05;

/// Compares the scene, engine and budget of `cell`, with seeds as repetitions. Gives a record of processor time, unless
/// seconds are the budget. Gives one of relmse if both runs have it for the same seeds against the same reference.
std::vector<ChangeRecord> stored_changes(const Results& old_run, const Results& new_run, const Cell& cell,
                                         const ChangeThresholds& thresholds);

}  // namespace photonproof::inline harness_conclusions
