// Whether the times of a run may be believed: how busy the machine was, whether an engine that was measured twice
// agrees with itself, whether there are enough repetitions.
#pragma once

#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// "load average 5.2 on 2 cores when it began: ..."; empty where fewer wait than there are cores, or the system does
/// not say.
std::string load_caveat(int cores);
/// The same of a given load average.
std::string load_caveat(double load, int cores);

/// The control, engine `control` measured a second time as `twin`, as a ratio of wall times of the cells both have:
/// says that the session is noisy where its 95 % interval excludes 1, or that too few pairs tell nothing. Empty when
/// all is well.
std::string control_caveat(const Results& results, const std::string& control, const std::string& twin);

}  // namespace photonproof::inline harness_conclusions
