#include "scenes/sky/sun_irradiance.h"

#include <algorithm>

namespace photonproof::inline scenes_sky {
namespace {

/// A place between two of `count` numbers: the lower one, and the share of the way to the next.
struct Between {
  Between(double place, std::size_t count)
      : low(static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 2)))),
        above(std::clamp(place - static_cast<double>(low), 0.0, 1.0)) {}
  double weight(std::size_t step) const { return step == 1 ? above : 1 - above; }
  std::size_t low;
  double above;
};

}  // namespace

RgbD sun_irradiance(double height, double turbidity) {
  const Between air(turbidity - 1, sun_turbidities), row((height - sun_first_height) / sun_height_step, sun_heights);
  RgbD sum(0.0);
  for (const std::size_t i : {0, 1})
    for (const std::size_t j : {0, 1}) {
      const auto& [red, green, blue] = sun_irradiance_table[(air.low + i) * sun_heights + row.low + j];
      sum += RgbD{red, green, blue} * (air.weight(i) * row.weight(j));
    }
  return {std::max(sum.x, 0.0), std::max(sum.y, 0.0), std::max(sum.z, 0.0)};
}

}  // namespace photonproof::inline scenes_sky
