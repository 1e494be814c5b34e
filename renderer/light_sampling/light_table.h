// How lights are chosen without looking at the place: half by flux, half evenly, in constant time.
#pragma once

#include <vector>

#include "renderer/light_sampling/light_words.h"
#include "renderer/lights/light.h"

namespace photonproof::inline renderer_light_sampling {

/// One entry a light, an alias table of Vose (1991): slot i, drawn uniformly, keeps light i with probability
/// alias_threshold and stands for `alias` otherwise. A light's probability is the mean of its share of the flux and
/// of an even share: a weak light next to a surface is found often enough. Lights without any flux get none. Infinite
/// lights together get at least an even share and at most half: their flux is that into the ball around the scene,
/// which says little about what lights a place. `primitive` is left to the caller.
std::vector<LightWords> light_table(const std::vector<Light>& lights);

/// The records of lights that kernels sample in lanes, LightKinds::stride floats each; of others there is none.
std::vector<float> light_records(const std::vector<Light>& lights);

}  // namespace photonproof::inline renderer_light_sampling
