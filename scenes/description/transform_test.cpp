#include "scenes/description/transform.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace photonproof::inline scenes_description {
namespace {

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(transform, rotates_counterclockwise_seen_from_the_tip_of_the_axis) {
  // A right-handed quarter turn takes x to y about z, y to z about x, z to x about y.
  EXPECT_EQ(Transform::rotate({0, 0, 1}, 90).vector({1, 0, 0}), Vec3d(0, 1, 0));
  EXPECT_EQ(Transform::rotate({1, 0, 0}, 90).vector({0, 1, 0}), Vec3d(0, 0, 1));
  EXPECT_EQ(Transform::rotate({0, 1, 0}, 90).vector({0, 0, 1}), Vec3d(1, 0, 0));
}

TEST(transform, rotates_by_multiples_of_90_degrees_without_rounding) {
  const Vec3d v(1, 2, 3);
  EXPECT_EQ(Transform::rotate({0, 1, 0}, -90).vector(v), Vec3d(-3, 2, 1));
  EXPECT_EQ(Transform::rotate({0, 1, 0}, 270).vector(v), Vec3d(-3, 2, 1));
  EXPECT_EQ(Transform::rotate({0, 0, 5}, 180).vector(v), Vec3d(-1, -2, 3));
  EXPECT_EQ(Transform::rotate({1, 1, 1}, 720), Transform());
}

TEST(transform, rotates_about_a_diagonal) {
  // 120 degrees about (1,1,1) permutes the axes: x to y to z to x. The axis' length does not matter, not even 1e200.
  expect_near(Transform::rotate({2, 2, 2}, 120).vector({1, 0, 0}), {0, 1, 0});
  expect_near(Transform::rotate({1e200, 1e200, 1e200}, 120).vector({0, 0, 1}), {1, 0, 0});
}

TEST(transform, applies_the_right_factor_first) {
  // Scaled, then moved: 1 -> 2 -> 12. Moved, then scaled: 1 -> 11 -> 22.
  const Transform scale = Transform::scale(Vec3d(2.0)), move = Transform::translate({10, 0, 0});
  EXPECT_EQ((move * scale).point({1, 0, 0}), Vec3d(12, 0, 0));
  EXPECT_EQ((scale * move).point({1, 0, 0}), Vec3d(22, 0, 0));
  EXPECT_EQ((move * scale).vector({1, 0, 0}), Vec3d(2, 0, 0));  // directions are not moved
}

TEST(transform, look_at_maps_the_local_frame_as_mitsuba_does) {
  // From (0,0,3.9) towards the origin: +z goes to -z, +y stays, and x = up x forward = y x (-z) = -x, the viewer's
  // left.
  const Transform t = Transform::look_at({0, 0, 3.9}, {0, 0, 0}, {0, 1, 0});
  EXPECT_EQ(t.point({0, 0, 0}), Vec3d(0, 0, 3.9));
  EXPECT_EQ(t.vector({0, 0, 1}), Vec3d(0, 0, -1));
  EXPECT_EQ(t.vector({0, 1, 0}), Vec3d(0, 1, 0));
  EXPECT_EQ(t.vector({1, 0, 0}), Vec3d(-1, 0, 0));
}

TEST(transform, look_at_is_rigid_for_a_tilted_up) {
  const Transform t = Transform::look_at({1, 2, 3}, {-4, 0, 7}, {0.3, 1, 0.2});
  EXPECT_NEAR(t.determinant(), 1, 1e-12);
  expect_near(cross(t.vector({1, 0, 0}), t.vector({0, 1, 0})), t.vector({0, 0, 1}));
}

TEST(transform, determinant_is_the_change_of_volume) {
  EXPECT_EQ(Transform::scale({2, 3, -4}).determinant(), -24);
  EXPECT_NEAR(Transform::rotate({1, 2, 3}, 77).determinant(), 1, 1e-14);
}

TEST(transform, inverse_undoes_random_transforms_of_any_scale) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const double size = std::exp(80 * unit(random));
    const Transform t = Transform::translate({size * unit(random), size, 0}) *
                        Transform::rotate({unit(random), 1, unit(random)}, 360 * unit(random)) *
                        Transform::scale({size, 2 * size, -0.5 * size}) *
                        Transform::rotate({1, unit(random), 0}, 360 * unit(random));
    const auto inverse = t.inverse();
    ASSERT_TRUE(inverse.has_value());
    // The condition number is 4, so a few dozen roundings of 1e-16.
    expect_near(inverse->point(t.point({0.3, -0.7, 0.9})), {0.3, -0.7, 0.9}, 1e-13);
  }
}

TEST(transform, inverse_refuses_what_flattens_space) {
  EXPECT_FALSE(Transform::scale({1, 1, 0}).inverse());
  EXPECT_FALSE(Transform::scale(Vec3d(0.0)).inverse());
  // Flattened along a diagonal, where rounding leaves a determinant near 1e-17 instead of 0.
  EXPECT_FALSE(
      (Transform::rotate({0, 1, 0}, 33) * Transform::scale({1, 1, 0}) * Transform::rotate({1, 0, 0}, 71)).inverse());
  Transform not_finite;
  not_finite.m[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(not_finite.inverse());
  EXPECT_FALSE(Transform::scale(Vec3d(1e-320)).inverse());  // its inverse overflows
}

TEST(transform, inverse_accepts_very_flat_but_regular_scales) {
  const auto inverse = Transform::scale({1, 1, 1e-20}).inverse();
  ASSERT_TRUE(inverse.has_value());
  expect_near(inverse->vector({0, 0, 1e-20}), {0, 0, 1});
}

}  // namespace
}  // namespace photonproof::inline scenes_description
