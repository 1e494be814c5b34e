// What several findings have in common is said once, and first.
#pragma once

#include <vector>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

/// Objects that are missing become one finding. Where every sphere of several is wrong, each in its own way, that is
/// said before what each shows. `findings` in the order of what they explain, and so left.
void join_common_causes(const SceneKnowledge& knowledge, std::vector<Finding>& findings);

}  // namespace photonproof::inline harness_diagnosis
