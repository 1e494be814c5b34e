// Spheres put where a scene has room.
#pragma once

#include <cstdint>
#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// Adds two to four spheres, diffuse, mirror and glass in turn from a seeded one on, which touch nothing and are seen
/// by the camera. Says what it added. Throws InputError where the scene has no room or no bounds.
std::string add_spheres(SceneDescription& scene, std::uint64_t seed);

}  // namespace photonproof::inline harness_variants
