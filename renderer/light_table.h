// How lights are chosen: with probability proportional to flux, in constant time.
#pragma once

#include <vector>

#include "renderer/light.h"
#include "renderer/scene_view.h"

namespace photonproof {

/// One entry a light, an alias table of Vose (1991): slot i, drawn uniformly, keeps light i with probability
/// alias_threshold and stands for `alias` otherwise. Lights without any flux share one probability. Where finite and
/// infinite lights both shine, neither gets less than a quarter together: the flux of infinite ones is that into the
/// ball around the scene, which says little about what lights a place. `primitive` is left to the caller.
std::vector<LightWords> light_table(const std::vector<Light>& lights);

/// The records of lights that kernels sample in lanes, LightKinds::stride floats each; of others there is none.
std::vector<float> light_records(const std::vector<Light>& lights);

}  // namespace photonproof
