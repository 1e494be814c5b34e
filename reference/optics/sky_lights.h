// Environment light as parallel lights, one for each of equal shares of the sky's flux. The few hundred rays of
// radiosity sample a sunlit sky noisily; this many lights integrate it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline reference_optics {

/// Light from a direction (unit length, world space) with its irradiance on a surface that faces it.
struct SkyLight {
  Vec3d from;
  RgbD irradiance;
};

/// A sunsky without its sun's disc as an environment map, oriented like the sunsky.
EmitterDescription sky_without_sun(const EmitterDescription& sunsky);

/// An envmap's image, with its rows inside the edges, as POV-Ray places them, times `gain`. It is so fine that
/// interpolation at the poles does not matter.
std::shared_ptr<const Image> sky_image(const EnvmapDescription& map, double gain);

/// side x side lights of an envmap: one direction from each stratum of its radiance. Together they have its flux in
/// every channel. The same seed gives the same lights. Empty where the map is black.
std::vector<SkyLight> sky_lights(const EnvmapDescription& map, int side, std::uint64_t seed);

/// side x side lights of the disc of a sunsky's sun; empty when it has set.
std::vector<SkyLight> sun_lights(const SunSkyDescription& sunsky, int side, std::uint64_t seed);

}  // namespace photonproof::inline reference_optics
