// Puts spheres into the free space of a scene.
#pragma once

#include <cstdint>
#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// Adds two to four spheres that touch nothing and are visible to the camera. They are diffuse, mirror and glass in
/// turn, starting with a seeded one. Returns a description. Throws InputError where the scene has no room or no bounds.
std::string add_spheres(SceneDescription& scene, std::uint64_t seed);

}  // namespace photonproof::inline harness_variants
