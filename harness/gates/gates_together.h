// The common conclusion of a scene's gates: the engines that fail where others pass, and the code that only the failing
// ones of ours run. A single gate's sentence names a place; only together do they narrow down a cause.
#pragma once

#include <string>
#include <vector>

#include "harness/suites/suite.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_gates {

/// A sentence for each scene on which one engine fails and another passes, or on which all of several fail. An example:
///   "cornell: path fails where photonmapper passes: look at weights of lights that bounces meet, or diffuse bounces".
/// An engine fails on a scene when its images do, and passes when all its gates there do. Gates without images to judge
/// (GateRecord::status) count as neither. Scenes are in the order of the gates.
std::vector<std::string> gates_together(const std::vector<GateRecord>& gates, const SuiteCommon& suite);

}  // namespace photonproof::inline harness_gates
