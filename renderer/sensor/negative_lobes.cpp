#include "renderer/sensor/negative_lobes.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline renderer_sensor {
namespace {

/// m of the two axes' integrals b.
double subtracted_by(double x, double y) { return (1 + x) * y + x * (1 + y); }

}  // namespace

NegativeLobes::NegativeLobes(const ReconstructionFilter& filter, bool sample_border, int width, int height) {
  if (!has_negative_lobes(filter.kind)) return;
  const FilterKernel kernel(filter);
  const auto integrals = [&](int size) {
    std::vector<double> negative;
    for (int at = 0; at < size; ++at) {
      const double before = sample_border ? kernel.radius() : at + 0.5,
                   after = sample_border ? kernel.radius() : size - at - 0.5;
      const FilterKernel::Lobes low = kernel.half_lobes(before), high = kernel.half_lobes(after);
      const double b = low.negative + high.negative;
      negative.push_back(b / (low.positive + high.positive - b));
    }
    return negative;
  };
  const double b = 2 * kernel.half_lobes(kernel.radius()).negative;
  inner_ = subtracted_by(b, b);
  columns_ = integrals(width);
  rows_ = integrals(height);
}

double NegativeLobes::subtracted(int x, int y) const {
  return subtracted_by(columns_[static_cast<std::size_t>(x)], rows_[static_cast<std::size_t>(y)]);
}

std::int64_t negative_samples(double subtracted, std::int64_t positive_samples) {
  if (!(subtracted > 0)) return 0;
  const double best = std::ceil(static_cast<double>(positive_samples) * subtracted / (1 + subtracted));
  return std::max(std::min<std::int64_t>(positive_samples, 2), static_cast<std::int64_t>(best));
}

}  // namespace photonproof::inline renderer_sensor
