#include "reference/engines/ies_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace photonproof::inline reference_engines {
namespace {

constexpr int around = 360, up = 8 * 180 + 1;

/// Place of a value among ascending angles: the one before it and the share of the way to the next.
struct Between {
  std::size_t index = 0;
  double share = 0;
};
Between between(const std::vector<double>& angles, double value) {
  if (angles.size() < 2) return {};
  const auto next = std::upper_bound(angles.begin() + 1, angles.end() - 1, value);
  const auto i = static_cast<std::size_t>(next - angles.begin()) - 1;
  return {i, (value - angles[i]) / (angles[i + 1] - angles[i])};
}

/// Maps an angle into the file's range by its symmetry.
double folded(const IesProfile& profile, double horizontal) {
  const double last = profile.horizontal_degrees.back();
  if (last <= 0) return 0;
  if (last > 180) return horizontal;
  const double half = std::min(horizontal, 360 - horizontal);
  return last > 90 ? half : std::min(half, 180 - half);
}

double candela_at(const IesProfile& profile, double vertical, double horizontal) {
  const std::vector<double>& rows = profile.vertical_degrees;
  if (vertical < rows.front() || vertical > rows.back()) return 0;
  const Between v = between(rows, vertical), h = between(profile.horizontal_degrees, folded(profile, horizontal));
  double sum = 0;
  for (const std::size_t j : {0u, 1u})
    for (const std::size_t i : {0u, 1u}) {
      const double weight = (j == 1 ? h.share : 1 - h.share) * (i == 1 ? v.share : 1 - v.share);
      if (weight > 0) sum += weight * profile.candela[(h.index + j) * rows.size() + v.index + i];
    }
  return sum;
}

}  // namespace

Image ies_image(const IesProfile& profile) {
  Image image(around, up);
  for (int y = 0; y < up; ++y)
    for (int x = 0; x < around; ++x) {
      const auto candela = static_cast<float>(candela_at(profile, 180.0 * y / (up - 1), 360.0 * x / around));
      std::fill_n(image.pixel(x, y), 3, candela);
    }
  return image;
}

}  // namespace photonproof::inline reference_engines
