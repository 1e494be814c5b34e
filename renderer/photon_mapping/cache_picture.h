// The view `cache-records`: where the records of an irradiance cache lie. The image's brightness B, dimmed to 0.3 B /
// (B + 0.5), and on it a dot wherever a camera path ends within a pixel of a record, so that mirrors show the dots of
// what they show. A dot's colour says how far its record is used, in pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/kernels/gather_points.h"
#include "renderer/photon_mapping/irradiance_cache.h"
#include "renderer/sensor/camera_view.h"

namespace photonproof::inline renderer_photon_mapping {

/// From red over yellow and green to blue, of equal steps in its logarithm: 1.5, 4, 9 and 24 pixels.
Rgb colour_of_reach(float pixels);

/// Of a tile in a pass.
struct PicturedPaths {
  const GatherQueue& ends;                     ///< where paths first met Lambertian surfaces
  const std::vector<std::uint32_t>& pixel_of;  ///< of each path
  const std::vector<std::uint32_t>& count;     ///< paths of each pixel
  const std::vector<Rgb>& sum;                 ///< of their radiance, of each pixel
};

/// For each pixel.
std::vector<Rgb> cache_picture(const IrradianceCache& cache, const CameraView& camera, const PicturedPaths& paths);

}  // namespace photonproof::inline renderer_photon_mapping
