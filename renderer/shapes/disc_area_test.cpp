// The clipped gather disc compared with closed forms and counting.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/lanes/test_random.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_shapes {
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

TEST(disc_area, on_a_sphere_is_pi_r_squared_up_to_where_the_tangent_plane_is_too_far) {
  // The cap of height h has the area 2 pi R h. The height is r^2 / 2R as long as that is below r/4, then r/4, and at
  // most R/4, where normals are 41 degrees apart.
  const Sphere sphere{{0, 0, 0}, 1, false};
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 0.4f), std::numbers::pi * 0.16, 1e-6);
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 0.5f), std::numbers::pi * 0.25, 1e-6);
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 0.8f), 2 * std::numbers::pi * 0.2, 1e-6);
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 9), 2 * std::numbers::pi * 0.25, 1e-6);
}

/// A shape cut into a million pieces about each of some points: `at(u, v)` gives place, size and normal of each.
struct Piece {
  Vec3d p, normal;
  double area;
};
template <class At>
double counted(const Vec3d& p, const Vec3d& normal, double radius, const At& at) {
  constexpr int n = 1000;
  double area = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Piece piece = at((i + 0.5) / n, (j + 0.5) / n);
      const Vec3d off = piece.p - p;
      if (length(off) <= radius && std::abs(dot(off, normal)) <= 0.25 * radius && dot(piece.normal, normal) >= 0.75)
        area += piece.area / n / n;
    }
  return area;
}

TEST(disc_area, on_a_cylinder_is_what_counting_finds) {
  const Cylinder cylinder{{1, 2, 3}, {0, 0, 1}, 1.5f, 0.7f, false};
  for (const double height : {0.75, 0.1, 0.0, 1.5})
    for (const double radius : {0.2, 0.34, 0.5, 1.2, 6.0}) {
      const Vec3d p{1.7, 2, 3 + height};
      const double span = 1.6;  // beyond +-0.8 normals are more than 45 degrees off
      const double expected = counted(p, {1, 0, 0}, radius, [&](double u, double v) -> Piece {
        const double a = span * (u - 0.5);
        const Vec3d n{std::cos(a), std::sin(a), 0};
        return {Vec3d{1, 2, 3 + 1.5 * v} + n * 0.7, n, span * 0.7 * 1.5};
      });
      EXPECT_NEAR(disc_area(cylinder, Vec3f(p), static_cast<float>(radius)), expected, 4e-3 * expected)
          << height << " " << radius;
    }
}

TEST(disc_area, on_a_narrow_stretch_of_a_wide_cylinder_is_the_rectangles) {
  // R = 1000 r: flat to 1e-6. Between borders 0.05 and 0.02 away the strip has of the circle of radius 0.1 two segments
  // less: sum of h sqrt(r^2 - h^2) + r^2 asin(h/r).
  const Cylinder cylinder{{0, 0, 0}, {0, 0, 1}, 0.07f, 100, false};
  const auto side = [](double h) { return h * std::sqrt(0.01 - h * h) + 0.01 * std::asin(h / 0.1); };
  EXPECT_NEAR(disc_area(cylinder, {100, 0, 0.05f}, 0.1f) / (side(0.05) + side(0.02)), 1, 1e-5);
}

TEST(disc_area, on_a_disk_is_the_lens_of_two_circles) {
  // The area of two circles' intersection: r^2 acos((d^2 + r^2 - R^2) / 2dr) + R^2 acos((d^2 + R^2 - r^2) / 2dR)
  //   `- 1/2 sqrt((-d+r+R) (d+r-R) (d-r+R) (d+r+R))`.
  const Disk disk{{5, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}};
  for (const double d : {1.9, 1.95, 1.2, 2.0})
    for (const double r : {0.3, 0.9, 2.5}) {
      const double R = 2;
      if (d + r <= R || d + R <= r) continue;
      const double lens = r * r * std::acos((d * d + r * r - R * R) / (2 * d * r)) +
                          R * R * std::acos((d * d + R * R - r * r) / (2 * d * R)) -
                          0.5 * std::sqrt((-d + r + R) * (d + r - R) * (d - r + R) * (d + r + R));
      const double c = d * 0.6, s = d * 0.8;
      EXPECT_NEAR(disc_area(disk, Vec3f(Vec3d(5 + c, s, 0)), static_cast<float>(r)) / lens, 1, 1e-5) << d << " " << r;
    }
  EXPECT_NEAR(disc_area(disk, {5.5f, 0, 0}, 0.3f), std::numbers::pi * 0.09, 1e-6);
  EXPECT_NEAR(disc_area(disk, {5.5f, 0, 0}, 3), 4 * std::numbers::pi, 1e-4);
}

TEST(disc_area, on_an_ellipse_is_what_counting_finds) {
  const Vec3f u{1.2f, 0.3f, 0}, v{-0.1f, 0.4f, 0.5f};
  const Vec3f normal = normalize(cross(u, v));
  const Disk disk{{0, 1, 0}, u, v, normal};
  for (const Vec2<float>& at : {Vec2<float>{0.1f, 0.2f}, Vec2<float>{0.9f, 0.3f}, Vec2<float>{-0.2f, 0.95f}})
    for (const double radius : {0.15, 0.6, 1.1}) {
      const Vec3d p = Vec3d(disk.center + u * at.x + v * at.y);
      const double expected = counted(p, Vec3d(normal), radius, [&](double a, double b) -> Piece {
        const double x = 2 * a - 1, y = 2 * b - 1;
        const double area = x * x + y * y <= 1 ? 4 * double{length(cross(u, v))} : 0;
        return {Vec3d(disk.center) + Vec3d(u) * x + Vec3d(v) * y, Vec3d(normal), area};
      });
      EXPECT_NEAR(disc_area(disk, Vec3f(p), static_cast<float>(radius)), expected, 3e-3 * expected)
          << at.x << " " << radius;
    }
}

}  // namespace
}  // namespace photonproof::inline renderer_shapes
