#include "harness/diagnosis/sub_pixel_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace photonproof::inline harness_diagnosis {
namespace {

/// Sums of least squares for two unknowns.
struct Normal {
  double xx = 0, xy = 0, yy = 0, xd = 0, yd = 0, dd = 0, count = 0;

  void add(double gx, double gy, double d, double weight) {
    xx += weight * gx * gx;
    xy += weight * gx * gy;
    yy += weight * gy * gy;
    xd += weight * gx * d;
    yd += weight * gy * d;
    dd += weight * d * d;
    count += 1;
  }
  void add(const Normal& n) {
    xx += n.xx;
    xy += n.xy;
    yy += n.yy;
    xd += n.xd;
    yd += n.yd;
    dd += n.dd;
    count += n.count;
  }
  double determinant() const { return xx * yy - xy * xy; }
  std::array<double, 2> solved() const {
    return {(xd * yy - yd * xy) / determinant(), (yd * xx - xd * xy) / determinant()};
  }
};

/// Sums for the four quarters of the picture.
std::array<Normal, 4> quarters_of(const Image& expected, const Comparison& comparison) {
  std::array<Normal, 4> quarters;
  const int width = comparison.width(), height = comparison.height();
  const double noise = comparison.noise_of(expected), least = 9 * std::max(noise * noise, 1e-5);
  const auto shown = [&](int x, int y, int c) { return comparison.shown(expected.pixel(x, y)[c]); };
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (!comparison.counts(pixel)) continue;
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = 3 * pixel + static_cast<std::size_t>(c);
        const double gx = (shown(x - 1, y, c) - shown(x + 1, y, c)) / 2;
        const double gy = (shown(x, y - 1, c) - shown(x, y + 1, c)) / 2;
        const double d = comparison.shown(comparison.submitted().rgb[i]) - shown(x, y, c);
        if (gx * gx + gy * gy < least) continue;  // noise alone, which would make the shift look smaller
        if (!std::isfinite(gx) || !std::isfinite(gy) || !std::isfinite(d)) continue;
        quarters[static_cast<std::size_t>(2 * (2 * y >= height) + (2 * x >= width))].add(gx, gy, d,
                                                                                         1 / comparison.variance_at(i));
      }
    }
  return quarters;
}

}  // namespace

std::optional<SubPixelShift> sub_pixel_shift(const Image& expected, const Comparison& comparison) {
  constexpr double shared = 3;  // noise of photon maps is shared by neighbours
  if (comparison.width() < 16 || comparison.height() < 16) return std::nullopt;
  const std::array<Normal, 4> quarters = quarters_of(expected, comparison);
  Normal all;
  for (const Normal& quarter : quarters) all.add(quarter);
  if (!(all.determinant() > 1e-3 * all.xx * all.yy)) return std::nullopt;
  const auto [x, y] = all.solved();
  const double size = std::hypot(x, y);
  if (size < 0.3 || size > 1.5) return std::nullopt;
  // Each half of the picture by itself must give nearly the same shift.
  constexpr std::array<std::array<std::size_t, 2>, 4> halves{{{0, 1}, {2, 3}, {0, 2}, {1, 3}}};
  for (const auto& [one, other] : halves) {
    Normal half = quarters[one];
    half.add(quarters[other]);
    if (!(half.determinant() > 1e-3 * half.xx * half.yy)) return std::nullopt;
    const auto [half_x, half_y] = half.solved();
    if (std::hypot(half_x - x, half_y - y) > 0.5 * size) return std::nullopt;
  }
  const double gain = x * all.xd + y * all.yd, beyond = all.dd - all.count;
  SubPixelShift shift{x, y, beyond > 0 ? std::min(1.0, gain / beyond) : 1, std::sqrt(std::max(0.0, gain / shared))};
  if (shift.deviations < 12 || shift.explained < 0.15) return std::nullopt;
  return shift;
}

}  // namespace photonproof::inline harness_diagnosis
