// Checks the reliability of a run's times: how busy the machine was, whether an engine measured twice agrees with
// itself, and whether there are enough repetitions.
#pragma once

#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// "load average 5.2 on 2 cores when it began: ..."; empty if fewer processes wait than there are cores, or if the
/// system gives no load.
std::string load_caveat(int cores);
/// The same for a given load average.
std::string load_caveat(double load, int cores);

/// Compares engine `control` with its second measurement `twin` by the ratio of wall times of the cells both have.
/// Warns of a noisy session if its 95 % interval excludes 1, and of too few pairs for a result. Empty if there is no
/// warning.
std::string control_caveat(const Results& results, const std::string& control, const std::string& twin);

}  // namespace photonproof::inline harness_conclusions
