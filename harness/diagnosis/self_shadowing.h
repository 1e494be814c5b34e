// Surfaces that shadow themselves: rays that start on a surface meet it again, where rounding puts their start below
// it. Light is then lost in specks or blotches, here much of it and there none, however smoothly it falls. Most other
// mistakes take or add light evenly, or on both sides of what is right, as noise does.
#pragma once

#include <vector>

#include "harness/diagnosis/guess.h"

namespace photonproof::inline harness_diagnosis {

/// Looks at walls, floors and ceilings, away from their edges.
void add_self_shadowing(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                        std::vector<Candidate>& candidates);

}  // namespace photonproof::inline harness_diagnosis
