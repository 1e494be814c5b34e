// The view `cache-records`: positions of the records of an irradiance cache. The background is the image's brightness
// B, dimmed to 0.3 B / (B + 0.5). A dot marks each camera path that ends within a pixel of a record; mirrors show the
// dots of reflected surfaces. A dot's colour encodes how far its record is used, in pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/irradiance/irradiance_cache.h"
#include "renderer/kernels/gather_points.h"
#include "renderer/sensor/camera_view.h"

namespace photonproof::inline renderer_irradiance {

/// Colour from red over yellow and green to blue at 1.5, 4, 9 and 24 pixels, linear in the logarithm.
Rgb colour_of_reach(float pixels);

/// The camera paths of a tile in a pass.
struct PicturedPaths {
  const GatherQueue& ends;                     ///< Points where paths first met Lambertian surfaces.
  const std::vector<std::uint32_t>& pixel_of;  ///< Pixel of each path.
  const std::vector<std::uint32_t>& count;     ///< Number of paths of each pixel.
  const std::vector<Rgb>& sum;                 ///< Sum of the paths' radiance in each pixel.
};

/// Colour of each pixel.
std::vector<Rgb> cache_picture(const IrradianceCache& cache, const CameraView& camera, const PicturedPaths& paths);

}  // namespace photonproof::inline renderer_irradiance
