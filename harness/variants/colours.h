// Every colour of a scene, changed by one rule.
#pragma once

#include <functional>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

using ColourChange = std::function<RgbD(const RgbD&)>;

/// Of BSDFs (indices of metals too), textures, media and lamps. Throws InputError where a colour stands in a file, or
/// follows from the sky's.
void change_all_colours(SceneDescription& scene, const ColourChange& change);

/// Of lamps alone, by a factor; lit by a file's image, too. Throws InputError where a lamp's radiance is a texture.
void scale_lamps(SceneDescription& scene, double factor);

}  // namespace photonproof::inline harness_variants
