// A light cut in two.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// One of the scene's lights, counted by `which` modulo their number, becomes two that shine as it did: a rectangle is
/// cut across at this share of its side, along its other side where `along_y`; a point light's intensity is shared.
/// Throws InputError where the scene has no light of these kinds.
void split_a_light(SceneDescription& scene, int which, double share, bool along_y);

}  // namespace photonproof::inline harness_variants
