// Splits a light in two.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// Splits one of the scene's lights, number `which` modulo their number, into two that together shine like it. A
/// rectangle is cut at this share of one side, or of the other side if `along_y`. A point light's intensity is shared.
/// Throws InputError where the scene has no light of these kinds.
void split_a_light(SceneDescription& scene, int which, double share, bool along_y);

}  // namespace photonproof::inline harness_variants
