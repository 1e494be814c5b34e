#include "reference/optics/point_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace photonproof::inline reference_optics {
namespace {

TEST(square_points, have_one_in_every_cell_and_in_every_column_and_row) {
  for (const int n : {1, 2, 3, 8, 13}) {
    for (const std::uint64_t seed : {1u, 2u, 99u}) {
      std::set<int> cells, columns, rows;
      for (const auto& p : square_points(n, seed)) {
        cells.insert(static_cast<int>(p.x * n) + n * static_cast<int>(p.y * n));
        columns.insert(static_cast<int>(p.x * n * n));
        rows.insert(static_cast<int>(p.y * n * n));
        EXPECT_TRUE(p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1);
      }
      const auto count = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
      EXPECT_EQ(cells.size(), count) << n;
      EXPECT_EQ(columns.size(), count) << n;
      EXPECT_EQ(rows.size(), count) << n;
    }
  }
}

// Means of x, y and x y are those of the square, 1/2 and 1/4, so that a light is as bright to either side.
TEST(square_points, do_not_correlate) {
  for (const int n : {2, 4, 6, 8}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      double x = 0, y = 0, xy = 0;
      for (const auto& p : square_points(n, seed)) x += p.x, y += p.y, xy += p.x * p.y;
      EXPECT_NEAR(x / (n * n), 0.5, 1e-12);
      EXPECT_NEAR(y / (n * n), 0.5, 1e-12);
      EXPECT_NEAR(xy / (n * n), 0.25, 1e-12) << n << " of seed " << seed;
    }
  }
}

// 8 x 8 points on a light of 0.46 by 0.38, 0.4 above a point 1 in front of it and 0.6 to the side. The midpoint rule of
// 200 x 200 is the reference. With separate orders for columns and rows the error is up to 0.5 %.
TEST(square_points, light_as_the_whole_square_does) {
  const auto light = [](double u, double v) {
    const double x = 0.46 * (u - 0.5) - 0.6, z = 1 + 0.38 * (v - 0.5), y = 0.4;
    return y * z / std::pow(x * x + y * y + z * z, 2);
  };
  double whole = 0;
  for (int i = 0; i < 200 * 200; ++i) whole += light((i % 200 + 0.5) / 200, (i / 200 + 0.5) / 200) / (200 * 200);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    double sum = 0;
    for (const auto& p : square_points(8, seed)) sum += light(p.x, p.y) / 64;
    EXPECT_NEAR(sum / whole, 1, 0.002) << "seed " << seed;
  }
}

TEST(sphere_points, are_unit_vectors_around_the_middle) {
  for (const int count : {4, 25, 64}) {
    Vec3d sum{0, 0, 0};
    for (const Vec3d& n : sphere_points(count, 3)) {
      EXPECT_NEAR(length(n), 1, 1e-12);
      sum = sum + n;
    }
    EXPECT_LT(length(sum) / count, 0.5 / std::sqrt(count)) << count;
  }
}

}  // namespace
}  // namespace photonproof::inline reference_optics
