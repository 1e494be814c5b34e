#include "harness/statistics/radiance_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace photonproof::inline harness_statistics {

std::string why_variance_is_lost(const Image& image) {
  double brightest = 0;
  for (const float v : image.rgb) brightest = std::max(brightest, std::abs(double{v}));
  if (brightest == 0 || (brightest >= least_radiance && brightest <= most_radiance)) return {};
  return fmt::format(
      "has radiances of {:.2g}. Single precision holds the variance of radiances from {:g} to {:g}: give the scene's "
      "lights in another unit",
      brightest, least_radiance, most_radiance);
}

}  // namespace photonproof::inline harness_statistics
