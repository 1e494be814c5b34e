#include "scenes/generators/gradient_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace photonproof::inline scenes_generators {
namespace {

Vec3d point(std::uint32_t i) {
  return Vec3d{unit_hash(i, 0, 0, 7), unit_hash(i, 1, 0, 7), unit_hash(i, 2, 0, 7)} * 200.0 - Vec3d(100.0);
}

TEST(gradient_noise, vanishes_at_whole_coordinates_and_stays_within_its_range) {
  for (int i = -3; i <= 3; ++i) EXPECT_EQ(gradient_noise(Vec3d(i, 2 * i, -i), 5), 0);
  double low = 0, high = 0;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    const double v = gradient_noise(point(i), 5);
    low = std::min(low, v);
    high = std::max(high, v);
  }
  // At the middle of a cell eight corners give at most 1/8 each of a slope of 1: the range is [-1,1], rarely filled.
  EXPECT_GE(low, -1.04);
  EXPECT_LT(low, -0.6);
  EXPECT_LE(high, 1.04);
  EXPECT_GT(high, 0.6);
}

TEST(gradient_noise, has_no_jumps_across_cells) {
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Vec3d p = point(i);
    p.x = std::floor(p.x);
    EXPECT_NEAR(gradient_noise(p - Vec3d{1e-9, 0, 0}, 5), gradient_noise(p + Vec3d{1e-9, 0, 0}, 5), 1e-8);
  }
}

TEST(gradient_noise, differs_by_seed_and_octave) {
  const Vec3d p{0.3, 0.6, 0.2};
  EXPECT_NE(gradient_noise(p, 1), gradient_noise(p, 2));
  EXPECT_EQ(fractal_noise(p, 1, 1), gradient_noise(p, 1));
  EXPECT_NE(fractal_noise(p, 2, 1), fractal_noise(p, 1, 1));
}

TEST(gradient_noise, ridges_lie_between_0_and_2) {
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const double v = ridged_noise(point(i), 8, 3);
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 2);
  }
}

TEST(gradient_noise, hashes_spread_evenly) {
  // 16 bins of 4096 values each expect 256. Chi-squared has the mean 15 and the variance 30, its mean over 1000 seeds a
  // standard deviation of sqrt(30 / 1000) = 0.17: too even would be as wrong as uneven.
  double sum = 0;
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    std::array<int, 16> bins{};
    for (std::uint32_t i = 0; i < 4096; ++i) ++bins[hash_of(i % 16, i / 16 % 16, i / 256, seed) & 15];
    for (const int n : bins) sum += (n - 256) * (n - 256) / 256.0;
  }
  EXPECT_NEAR(sum / 1000, 15, 4 * 0.17);
}

}  // namespace
}  // namespace photonproof::inline scenes_generators
