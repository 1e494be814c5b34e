// What the gates of a scene say together: which engines fail where others pass, and what of ours the ones have and the
// others have not. A sentence each names a place; only together do they narrow down a cause.
#pragma once

#include <string>
#include <vector>

#include "harness/suites/suite.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_gates {

/// A sentence for each scene on which an engine fails and another one passes, or on which all of several fail:
///   "cornell: path fails where photonmapper passes: look at weights of lights that bounces meet, or diffuse bounces"
/// An engine fails on a scene when images of it do, and passes when all its gates there do. Gates without images to
/// judge (GateRecord::status) count as neither. Scenes in the order of the gates.
std::vector<std::string> gates_together(const std::vector<GateRecord>& gates, const SuiteCommon& suite);

}  // namespace photonproof::inline harness_gates
