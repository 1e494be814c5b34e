// What the stored numbers of two runs say about a change, where the old program cannot be run again. Two sessions on
// one machine differ for reasons of their own, so a time's interval is widened by what is usual, and most answers are
// "inconclusive".
#pragma once

#include <vector>

#include "harness/paired_rounds.h"
#include "harness/results.h"

namespace photonproof {

/// Factor by which the same program's processor time may differ between two sessions of one host (it does on two
/// shared virtual cores, idle and busy), beyond its noise within them.
inline constexpr double between_sessions = 1.25;
inline constexpr double between_calibrated_sessions = 1.1;

/// For the scene, engine and budget of `cell`: a record of processor time, unless seconds are the budget, and one of
/// relmse where both runs have it for the same seeds against the same reference. Seeds serve as repetitions.
std::vector<ChangeRecord> stored_changes(const Results& old_run, const Results& new_run, const Cell& cell,
                                         const ChangeThresholds& thresholds);

}  // namespace photonproof
