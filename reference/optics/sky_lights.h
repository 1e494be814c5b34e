// Light from all around as parallel lights: one for each of equal shares of the sky's flux. Radiosity's few hundred
// rays would see a sun-lit sky as noise; this many lights see it as an integral.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline reference_optics {

/// Light that comes from a direction, unit length and world space, with its irradiance on what it meets head on.
struct SkyLight {
  Vec3d from;
  RgbD irradiance;
};

/// A sunsky without its sun's disc as an environment map, in the world where the sunsky is.
EmitterDescription sky_without_sun(const EmitterDescription& sunsky);

/// An envmap's image, with its rows inside the edges, as POV-Ray has them, and so fine that how it interpolates at the
/// poles does not matter. Times `gain`.
std::shared_ptr<const Image> sky_image(const EnvmapDescription& map, double gain);

/// side x side lights of an envmap: directions by its radiance, a stratum each; together they have its flux in every
/// channel. The same seed gives the same lights. Empty where the map is black.
std::vector<SkyLight> sky_lights(const EnvmapDescription& map, int side, std::uint64_t seed);

/// side x side lights of the disc of a sunsky's sun; empty when it has set.
std::vector<SkyLight> sun_lights(const SunSkyDescription& sunsky, int side, std::uint64_t seed);

}  // namespace photonproof::inline reference_optics
