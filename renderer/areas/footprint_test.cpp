// The parts of flat shapes that solids cover, compared with counting points.

#include "renderer/areas/footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "renderer/planning/test_compiled.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_areas {
namespace {

/// 4 x 4 about the origin, facing +z.
const Quad table{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, 16};
/// A turned box: x along (c, s), half edges 0.5, 0.3, 0.2.
constexpr double c = 0.8, s = 0.6;
Solid box_at(const Vec3d& middle) {
  return {middle, {Vec3d(0.5 * c, 0.5 * s, 0), Vec3d(-0.3 * s, 0.3 * c, 0), {0, 0, 0.2}}, 0};
}

/// Area of the part of a disc in the table's plane where `covered` holds on the table, by a grid.
double counted(double x, double y, double radius, const std::function<bool(double, double)>& covered) {
  constexpr int n = 1500;
  int inside = 0;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double u = (2 * (i + 0.5) / n - 1) * radius, v = (2 * (k + 0.5) / n - 1) * radius;
      const bool on_table = std::abs(x + u) < 2 && std::abs(y + v) < 2;
      if (u * u + v * v < radius * radius && on_table && covered(x + u, y + v)) ++inside;
    }
  }
  return inside * (4 * radius * radius / (double{n} * n));
}

TEST(footprint, of_a_turned_box_is_what_counting_finds_also_over_an_edge) {
  for (const Vec3d middle : {Vec3d(0.3, 0.1, 0.2), Vec3d(1.9, -0.4, 0.1)}) {
    const auto in_box = [&](double x, double y) {
      const double dx = x - middle.x, dy = y - middle.y;
      return std::abs(c * dx + s * dy) < 0.5 && std::abs(c * dy - s * dx) < 0.3;
    };
    const std::optional<Footprint> found = Footprint::of(box_at(middle), table);
    ASSERT_TRUE(found);
    for (const double away : {0.0, 0.4, 0.7, 1.2})
      for (const double radius : {0.1, 0.5, 3.0})
        EXPECT_NEAR(found->in_disc({middle.x - away, middle.y, 0}, radius),
                    counted(middle.x - away, middle.y, radius, in_box), 2e-3 * radius * radius)
            << middle.x << " " << away << " " << radius;
  }
}

TEST(footprint, of_a_ball_is_the_circle_where_the_plane_cuts_it) {
  const Solid ball{{-0.2, 0.3, 0.3}, {}, 0.5};  // the circle's radius is 0.4
  const std::optional<Footprint> found = Footprint::of(ball, table);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->area() / (0.16 * 3.14159265), 1, 1e-6);
  const auto in_circle = [](double x, double y) { return std::hypot(x + 0.2, y - 0.3) < 0.4; };
  for (const double radius : {0.2, 0.7})
    EXPECT_NEAR(found->in_disc({0.15, 0.3, 0}, radius), counted(0.15, 0.3, radius, in_circle), 3e-3 * radius * radius);
}

TEST(footprint, is_of_the_side_that_the_solid_is_on) {
  const auto sides = [](double height) {
    const std::optional<Footprint> found = Footprint::of(box_at({0, 0, height}), table);
    return !found ? 0 : (found->covers(false) ? 1 : 0) + (found->covers(true) ? 2 : 0);
  };
  EXPECT_EQ(sides(0.2), 1);         // stands on it
  EXPECT_EQ(sides(-0.2), 2);        // hangs below
  EXPECT_EQ(sides(0.1), 3);         // is sunk in it
  EXPECT_EQ(sides(0.2 + 1e-7), 1);  // rounding
  EXPECT_EQ(sides(0.201), 0);
  EXPECT_FALSE(Footprint::of(box_at({5, 0, 0.2}), table));
  EXPECT_FALSE(Footprint::of(Solid{{0, 0, 0.5}, {}, 0.5}, table)) << "a ball touches it in a point";
}

TEST(footprint, on_a_plane_without_end_is_as_on_a_table) {
  const Plane endless{{7, -3, 0}, {0, 0, 1}};
  const auto on_plane = Footprint::of(box_at({0.3, 0.1, 0.2}), endless),
             on_table = Footprint::of(box_at({0.3, 0.1, 0.2}), table);
  ASSERT_TRUE(on_plane && on_table);
  EXPECT_NEAR(on_plane->in_disc({0.7, 0.1, 0}, 0.4), on_table->in_disc({0.7, 0.1, 0}, 0.4), 1e-9);
}

TEST(footprint, overlaps_what_shares_an_area) {
  const auto of = [](double x) { return *Footprint::of(box_at({x, 0, 0.2}), table); };
  EXPECT_TRUE(of(0).overlaps(of(0.3)));
  EXPECT_FALSE(of(0).overlaps(of(1.2)));
}

TEST(solid, of_a_cube_is_its_transform_applied_to_the_axes) {
  SceneDescription d;
  d.bsdfs.push_back({{}, "", DiffuseDescription{}});
  ShapeDescription cube;
  cube.geometry = CubeDescription{};
  cube.to_world = Transform::translate({1, 2, 3}) * Transform::rotate({0, 1, 0}, 90) * Transform::scale({0.5, 0.25, 2});
  d.shapes = {cube, cube};
  d.shapes[1].flip_normals = true;  // a room
  const Scene scene = test::compiled(d, 8, 8);
  ASSERT_EQ(scene.cubes.size(), 2);
  const auto solid = [&](std::size_t i) {
    std::array<const Quad*, 6> sides{};
    for (std::size_t k = 0; k < 6; ++k) sides[k] = &std::get<Quad>(scene.surfaces[scene.cubes[i] + k].geometry);
    return Solid::of_cube(sides);
  };
  ASSERT_TRUE(solid(0));
  const Vec3d moved = scene.frame.moved;
  EXPECT_NEAR(length(solid(0)->middle - moved - Vec3d(1, 2, 3)), 0, 1e-6);
  // Turned by 90 degrees about y, x is along -z and z along x.
  EXPECT_NEAR(solid(0)->reach_along({1, 0, 0}), 2, 1e-6);
  EXPECT_NEAR(solid(0)->reach_along({0, 1, 0}), 0.25, 1e-6);
  EXPECT_NEAR(solid(0)->reach_along({0, 0, 1}), 0.5, 1e-6);
  EXPECT_TRUE(solid(0)->holds(moved + Vec3d(2.9, 2.2, 3.4)));
  EXPECT_FALSE(solid(0)->holds(moved + Vec3d(1, 2.3, 3)));
  EXPECT_FALSE(solid(1)) << "faces inward";
}

}  // namespace
}  // namespace photonproof::inline renderer_areas
