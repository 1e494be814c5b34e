// The areas that gathers on curves divide by, compared with closed forms and with counting.
#include "renderer/areas/curve_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/shapes/cylinder.h"
#include "renderer/shapes/sphere.h"

namespace photonproof::inline renderer_areas {
namespace {

constexpr double pi_d = std::numbers::pi;

/// A straight tube along x from -length / 2 to length / 2.
Curves straight(bool linear, float length, float radius) {
  Curves curves;
  curves.linear = linear;
  const int points = linear ? 2 : 4;
  // The middle part of a B-spline of evenly spaced points is a third of their reach long.
  const float reach = linear ? length : 3 * length;
  for (int i = 0; i < points; ++i)
    curves.points.push_back({{reach * (static_cast<float>(i) / static_cast<float>(points - 1) - 0.5f), 0, 0}, radius});
  curves.segments = {0};
  return curves;
}

TEST(curve_area, of_a_straight_tube_is_the_cylinders) {
  const Cylinder cylinder{{-2, 0, 0}, {1, 0, 0}, 4, 0.5, false};
  for (const bool linear : {false, true}) {
    const CurveArea area(straight(linear, 4, 0.5f));
    for (const float radius : {0.01f, 0.1f, 0.3f, 0.7f, 1.5f})
      for (const float x : {0.0f, 0.4f}) {
        const double expected = disc_area(cylinder, {x, 0, 0.5f}, radius);
        EXPECT_NEAR(area.within({x, 0, 0.5f}, {0, 0, 1}, radius), expected, 1e-3 * expected) << linear << ' ' << radius;
      }
  }
}

TEST(curve_area, of_an_open_end_stops_there) {
  const Cylinder cylinder{{-2, 0, 0}, {1, 0, 0}, 4, 0.5, false};
  const CurveArea area(straight(false, 4, 0.5f));
  for (const float radius : {0.05f, 0.3f}) {
    const double expected = disc_area(cylinder, {1.9f, 0, 0.5f}, radius);
    EXPECT_NEAR(area.within({1.9f, 0, 0.5f}, {0, 0, 1}, radius), expected, 0.01 * expected);
  }
}

TEST(curve_area, of_a_round_end_is_the_spheres) {
  const Sphere ball{{2, 0, 0}, 0.5, false};
  const CurveArea area(straight(true, 4, 0.5f));
  for (const float radius : {0.01f, 0.1f, 0.3f}) {
    const double expected = disc_area(ball, {2.5f, 0, 0}, radius);
    EXPECT_NEAR(area.within({2.5f, 0, 0}, {1, 0, 0}, radius), expected, 2e-3 * expected) << radius;
  }
}

// A gather far wider than the tubes counts each tube's part of normals within acos 3/4 of its own, which is a strip.
TEST(curve_area, of_many_thin_tubes_is_that_of_their_strips) {
  Curves hair;
  hair.linear = true;
  constexpr int count = 400;
  for (int i = 0; i < count; ++i) {
    const float y = 0.01f * static_cast<float>(i - count / 2);
    hair.segments.push_back(static_cast<std::uint32_t>(hair.points.size()));
    hair.points.push_back({{-3, y, 0}, 0.001f});
    hair.points.push_back({{3, y, 0}, 0.001f});
  }
  const double strip = 2 * std::acos(0.75) * 0.001, radius = 1;
  EXPECT_NEAR(CurveArea(hair).within({0, 0, 0.001f}, {0, 0, 1}, 1), pi_d * radius * radius / 0.01 * strip,
              2e-3 * pi_d / 0.01 * strip);
}

TEST(curve_area, of_a_cone_counts_its_slant) {
  Curves cone = straight(true, 4, 0.5f);
  cone.points[0].radius = 0.4f;
  cone.points[1].radius = 0.6f;
  const double slant = std::sqrt(1 + 0.05 * 0.05);
  EXPECT_NEAR(CurveArea(cone).within({0, 0, 0.5f},
                                     {-0.05f / static_cast<float>(slant), 0, 1 / static_cast<float>(slant)}, 0.02f),
              pi_d * 0.02 * 0.02, 0.01 * pi_d * 0.02 * 0.02);
}

TEST(curve_area, without_a_tube_near_is_nothing) {
  EXPECT_EQ(CurveArea(straight(true, 4, 0.5f)).within({0, 0, 3}, {0, 0, 1}, 1), 0);
  EXPECT_EQ(CurveArea(straight(true, 4, 0.5f)).within({0, 0, 0.5f}, {0, 0, -1}, 0.1f), 0);
}

}  // namespace
}  // namespace photonproof::inline renderer_areas
