// The clipped look-up disc against closed forms and counting.

#include "renderer/disc_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/test_random.h"

namespace photonproof {
namespace {

const Quad unit_square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1};

TEST(disc_area, is_whole_half_and_quarter_where_the_square_leaves_that_much) {
  const double r = 0.1, disc = std::numbers::pi * r * r;
  EXPECT_NEAR(disc_area(unit_square, {0.5f, 0.5f, 0}, 0.1f), disc, 1e-8);
  EXPECT_NEAR(disc_area(unit_square, {0.5f, 0, 0}, 0.1f), disc / 2, 1e-8);
  EXPECT_NEAR(disc_area(unit_square, {0, 1, 0}, 0.1f), disc / 4, 1e-8);
}

TEST(disc_area, of_a_disc_that_covers_the_square_is_the_squares) {
  EXPECT_NEAR(disc_area(unit_square, {0.3f, 0.8f, 0}, 5), 1, 1e-7);
}

TEST(disc_area, near_an_edge_is_the_circular_segment) {
  // At distance h from one edge: pi r^2 - r^2 acos(h/r) + h sqrt(r^2 - h^2).
  const double r = 0.2, h = 0.05;
  const double expected = std::numbers::pi * r * r - r * r * std::acos(h / r) + h * std::sqrt(r * r - h * h);
  EXPECT_NEAR(disc_area(unit_square, {0.05f, 0.5f, 0}, 0.2f), expected, 1e-7);
}

TEST(disc_area, of_a_sheared_parallelogram_matches_counting) {
  // 1e6 points uniform over the parallelogram: the fraction within r has standard error below 5e-4 of area 2.
  const Quad quad{{1, 2, 3}, {2, 0, 0}, {0.7f, 1, 0}, {0, 0, 1}, 2};
  const Vec3f p = quad.corner + quad.edge_u * 0.1f + quad.edge_v * 0.2f;
  int inside = 0;
  constexpr int n = 1'000'000;
  test::Random s(43);
  for (int i = 0; i < n; ++i) {
    const auto u = s.next2();
    const Vec3f q = quad.corner + quad.edge_u * u.x + quad.edge_v * u.y;
    if (length_squared(q - p) <= 0.6f * 0.6f) ++inside;
  }
  EXPECT_NEAR(disc_area(quad, p, 0.6f), 2.0 * inside / n, 4e-3);
}

TEST(disc_area, on_a_sphere_is_pi_r_squared_up_to_the_whole_sphere) {
  const Sphere sphere{{0, 0, 0}, 1, false};
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 0.5f), std::numbers::pi / 4, 1e-6);
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 9), 4 * std::numbers::pi, 1e-5);
}

}  // namespace
}  // namespace photonproof
