#include "scenes/sky/sky_hosek_wilkie.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace photonproof::inline scenes_sky {
namespace {

using Table = HosekWilkieTable;

/// Weights of a table's entries: one turbidity's six points for one albedo, at most four times.
struct Weights {
  Weights(double turbidity, double sun_elevation) {
    low = std::clamp(static_cast<int>(turbidity), 1, Table::turbidities - 1);
    above = turbidity - low;
    // Bernstein's polynomials of the fifth degree: the sky changes fastest where the sun is low.
    const double t = std::cbrt(sun_elevation / (std::numbers::pi / 2)), s = 1 - t;
    points = {s * s * s * s * s,      5 * s * s * s * s * t, 10 * s * s * s * t * t,
              10 * s * s * t * t * t, 5 * s * t * t * t * t, t * t * t * t * t};
  }

  /// Interpolates the numbers at index `which` of every `stride` entries of a table.
  double sum(const double* table, int stride, int which, double albedo) const {
    double total = 0;
    for (const int white : {0, 1})
      for (const int step : {0, 1}) {
        const double weight = (white == 1 ? albedo : 1 - albedo) * (step == 1 ? above : 1 - above);
        const int first = (white * Table::turbidities + low - 1 + step) * Table::points;
        for (int i = 0; i < Table::points; ++i)
          total += weight * points[static_cast<std::size_t>(i)] * table[(first + i) * stride + which];
      }
    return total;
  }

  int low;       ///< the turbidity below; a table's first is 1
  double above;  ///< position between it and the next, 0 to 1
  std::array<double, Table::points> points{};
};

}  // namespace

HosekWilkieSky::HosekWilkieSky(double turbidity, double albedo, double sun_elevation) : channels_{} {
  const Weights weights(turbidity, sun_elevation);
  for (std::size_t i = 0; i < 3; ++i) {
    const Table& table = hosek_wilkie_tables[i];
    for (int p = 0; p < Table::parameters; ++p)
      channels_[i].shape[static_cast<std::size_t>(p)] = weights.sum(table.shape.data(), Table::parameters, p, albedo);
    channels_[i].mean = weights.sum(table.mean.data(), 1, 0, albedo);
  }
}

RgbD HosekWilkieSky::rgb(double cos_theta, double cos_gamma) const {
  const double gamma = std::acos(cos_gamma), from_zenith = std::sqrt(cos_theta);
  const auto at = [&](const Channel& channel) {
    const auto& [a, b, c, d, e, f, g, i, h] = channel.shape;
    const double forward = 1 + h * h - 2 * h * cos_gamma;  // around the sun: equation 9
    const double chi = (1 + cos_gamma * cos_gamma) / (forward * std::sqrt(forward));
    return channel.mean * (1 + a * std::exp(b / (cos_theta + 0.01))) *
           (c + d * std::exp(e * gamma) + f * cos_gamma * cos_gamma + g * chi + i * from_zenith);
  };
  return {at(channels_[0]), at(channels_[1]), at(channels_[2])};
}

}  // namespace photonproof::inline scenes_sky
