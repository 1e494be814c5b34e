// Every colour of a scene, changed by one rule.
#pragma once

#include <functional>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

using ColourChange = std::function<RgbD(const RgbD&)>;

/// Of BSDFs (indices of metals too), textures, media and lights. Throws InputError where a colour stands in a file, or
/// follows from the sky's.
void change_all_colours(SceneDescription& scene, const ColourChange& change);

/// Of lights alone, by a factor; lit by a file's image, too. Throws InputError where a light's radiance is a texture.
void scale_lights(SceneDescription& scene, double factor);

}  // namespace photonproof::inline harness_variants
