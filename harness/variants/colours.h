// Changes every colour of a scene by one rule.
#pragma once

#include <functional>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

using ColourChange = std::function<RgbD(const RgbD&)>;

/// Changes BSDFs (including metals' indices), textures, media and lights. Throws InputError where a colour is in a file
/// or follows from the sky's.
void change_all_colours(SceneDescription& scene, const ColourChange& change);

/// Scales the lights alone, including those from an image file. Throws InputError where a light's radiance is a
/// texture.
void scale_lights(SceneDescription& scene, double factor);

}  // namespace photonproof::inline harness_variants
