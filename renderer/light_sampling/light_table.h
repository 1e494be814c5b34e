// The choice of lights without regard to position: half by flux, half evenly, in constant time.
#pragma once

#include <vector>

#include "renderer/light_sampling/light_words.h"
#include "renderer/lights/light.h"

namespace photonproof::inline renderer_light_sampling {

/// One entry per light of an alias table (Vose 1991). Slot i, chosen uniformly, keeps light i with probability
/// alias_threshold and otherwise gives `alias`. A light's probability is the mean of its share of the flux and of an
/// even share. So a weak light next to a surface is found often enough. Lights without flux have probability 0.
/// Infinite lights together get at least an even share and at most half. Their flux is that into the ball around the
/// scene, which is a poor measure of their effect at a place. The caller sets `primitive`.
std::vector<LightWords> light_table(const std::vector<Light>& lights);

/// The same table with these probabilities, which add up to 1.
std::vector<LightWords> light_table(const std::vector<Light>& lights, const std::vector<double>& probabilities);

/// Records of the lights that kernels sample in lanes, LightKinds::stride floats each; unused for other lights.
std::vector<float> light_records(const std::vector<Light>& lights);

}  // namespace photonproof::inline renderer_light_sampling
