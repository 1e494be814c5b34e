#include "scenes/generators/lathe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/meshes/test_mesh_checks.h"

namespace photonproof::inline scenes_generators {
namespace {

using std::numbers::pi;

struct Measures {
  double area = 0, volume = 0;
};

/// The volume by the divergence theorem: positive where a closed surface faces outward.
Measures measures_of(const TriangleMesh& mesh) {
  Measures sums;
  for (const auto& triangle : mesh.triangles) {
    const Vec3d normal = normal_of(mesh, triangle);
    sums.area += length(normal) / 2;
    sums.volume += dot(Vec3d(mesh.positions[triangle[0]]), normal) / 6;
  }
  return sums;
}

/// V - E + F of a surface; adds a failure where it is not closed and of one orientation.
std::ptrdiff_t euler_characteristic(const TriangleMesh& mesh) {
  const EdgeCounts edges = count_edges(mesh.triangles);
  EXPECT_EQ(edges.border + edges.bad, 0u);
  return static_cast<std::ptrdiff_t>(mesh.positions.size()) - static_cast<std::ptrdiff_t>(edges.inner) +
         static_cast<std::ptrdiff_t>(mesh.triangles.size());
}

/// Normals have unit length, and no corner's is further than `degrees` from its face's.
void expect_smooth_normals(const TriangleMesh& mesh, double degrees) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const Vec3f& n : mesh.normals) EXPECT_NEAR(length(n), 1, 1e-6);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      EXPECT_GT(dot(normalize(normal_of(mesh, triangle)), Vec3d(mesh.normals[corner])), std::cos(degrees * pi / 180));
}

std::vector<TubePoint> half_circle(double radius, int steps) {
  std::vector<TubePoint> profile;
  for (int i = 0; i <= steps; ++i) {
    const double angle = pi * i / steps - pi / 2;
    const bool pole = i == 0 || i == steps;
    profile.push_back(
        {{pole ? 0 : radius * std::cos(angle), radius * std::sin(angle), 0}, {-std::sin(angle), std::cos(angle), 0}});
  }
  return profile;
}

TEST(lathe, sphere_has_the_area_and_the_volume_of_a_sphere) {
  const double r = 1.5;
  const std::uint32_t n = 96;
  const int m = 64;
  const TriangleMesh mesh = lathe(half_circle(r, m), Ends::axis, n);
  EXPECT_TRUE(mesh.is_padded());
  EXPECT_EQ(mesh.triangles.size(), 2u * n * (m - 1)) << "two fans of n, m - 2 bands of 2 n";
  EXPECT_EQ(euler_characteristic(mesh), 2);
  // A chord of the angle a is shorter than its arc by the factor 1 - a^2 / 24. Along the profile a = pi / m, around it
  // a = 2 pi / n. A face's height shrinks by up to 1 - (pi / n)^2 / 2 more, where it lies flat.
  const double most = std::pow(pi / m, 2) / 24 + std::pow(pi / n, 2) * (1.0 / 6 + 1.0 / 2);
  const auto [area, volume] = measures_of(mesh);
  EXPECT_LT(area, 4 * pi * r * r);
  EXPECT_GT(area, 4 * pi * r * r * (1 - most)) << "within " << most << ", 0.08 %";
  EXPECT_LT(volume, 4 * pi / 3 * r * r * r);
  EXPECT_GT(volume, 4 * pi / 3 * r * r * r * (1 - 2 * most));
  expect_smooth_normals(mesh, 4);  // faces are pi / m by 2 pi / n: no corner is further than 2.4 + 1.9 degrees off
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_LT(length(mesh.positions[i] / static_cast<float>(r) - mesh.normals[i]), 1e-6f) << i;
}

TEST(lathe, faces_are_the_trapezoids_between_two_circles) {
  const std::vector<TubePoint> cone = {{{2, 0, 0}, {0, 1, 0}}, {{1, 3, 0}, {0, 1, 0}}};
  for (const std::uint32_t n : {3u, 4u, 7u}) {
    const TriangleMesh mesh = lathe(cone, Ends::open, n);
    // Parallel sides 2 r sin(pi / n), distances from the axis r cos(pi / n).
    const double expected = n * std::sin(pi / n) * (2 + 1) * std::hypot(3, std::cos(pi / n));
    EXPECT_NEAR(measures_of(mesh).area, expected, 1e-5) << n;
    EXPECT_EQ(count_edges(mesh.triangles).border, 2 * n);
    for (const auto& t : mesh.triangles) EXPECT_GT(normal_of(mesh, t).y, 0) << "a cone that narrows upwards";
  }
}

TEST(lathe, ring_is_a_torus) {
  const double major = 2, minor = 0.5;
  const TriangleMesh mesh = torus(major, minor, 128, 64);
  EXPECT_EQ(mesh.triangles.size(), 2u * 128 * 64);
  EXPECT_EQ(euler_characteristic(mesh), 0);
  const auto [area, volume] = measures_of(mesh);
  EXPECT_NEAR(area / (4 * pi * pi * major * minor), 1, 0.002);  // Pappus
  EXPECT_NEAR(volume / (2 * pi * pi * major * minor * minor), 1, 0.003);
  expect_smooth_normals(mesh, 5);
}

TEST(smooth_curve, passes_its_controls_and_stays_smooth) {
  const std::vector<Vec3d> controls = {{0, 0, 0}, {1, 0.2, 0}, {1.2, 1, 0}, {0.4, 1.5, 0}, {0, 1.6, 0}};
  for (const Ends ends : {Ends::axis, Ends::open, Ends::loop}) {
    const int per_span = 16;
    const auto curve = smooth_curve(controls, per_span, ends);
    ASSERT_EQ(curve.size(), ends == Ends::loop ? 80u : 65u);
    for (std::size_t i = 0; i < controls.size(); ++i) EXPECT_LT(length(curve[i * 16].at - controls[i]), 1e-12) << i;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      EXPECT_NEAR(length(curve[i].tangent), 1, 1e-12);
      EXPECT_GT(dot(curve[i].tangent, normalize(curve[i + 1].at - curve[i].at)), std::cos(15 * pi / 180)) << i;
    }
  }
  const auto dome = smooth_curve(controls, 16, Ends::axis);
  EXPECT_EQ(dome.front().tangent, Vec3d(1, 0, 0));
  EXPECT_EQ(dome.back().tangent, Vec3d(-1, 0, 0));
  EXPECT_EQ(dome.back().at.x, 0);
  // Near the axis heights grow with the square of the radius. The mean slope of the last span is 0.25.
  EXPECT_LT(std::abs(dome[63].at.y - dome[64].at.y) / dome[63].at.x, 0.25 / 4);
  const auto bowl = smooth_curve({controls.rbegin(), controls.rend()}, 16, Ends::axis);
  EXPECT_LT(std::abs(bowl[1].at.y - bowl[0].at.y) / bowl[1].at.x, 0.25 / 4);
}

TEST(tube, has_round_ends_and_the_volume_of_a_capsule) {
  const double r = 0.25, l = 3;
  std::vector<TubePoint> line;
  for (int i = 0; i <= 8; ++i) line.push_back({{0, l * i / 8, 0}, {0, 1, 0}});
  const TriangleMesh mesh = tube(line, std::vector<double>(line.size(), r), Ends::open, 64);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  // Ends of four steps lose up to (pi / 8)^2 / 6 = 3 % of their ball, itself a tenth of the whole.
  EXPECT_NEAR(measures_of(mesh).volume / (pi * r * r * (l + 4 * r / 3)), 1, 0.006);
  expect_smooth_normals(mesh, 17);  // half of an end's step of 22.5 degrees, and its tip
}

TEST(tube, loop_closes_without_a_twist) {
  std::vector<Vec3d> controls;  // not in a plane, so that frames come back turned
  for (int i = 0; i < 24; ++i) {
    const double t = 2 * pi * i / 24;
    controls.push_back({2 * std::cos(t), 0.6 * std::sin(2 * t), 2 * std::sin(t) + 0.4 * std::cos(3 * t)});
  }
  const auto curve = smooth_curve(controls, 8, Ends::loop);
  const TriangleMesh mesh = tube(curve, std::vector<double>(curve.size(), 0.2), Ends::loop, 24);
  EXPECT_EQ(euler_characteristic(mesh), 0);
  double along = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) along += length(curve[(i + 1) % curve.size()].at - curve[i].at);
  EXPECT_NEAR(measures_of(mesh).volume / (pi * 0.2 * 0.2 * along), 1, 0.015);  // Pappus; a 24-gon has 1.1 % less
  expect_smooth_normals(mesh, 12);
}

TEST(sheet, faces_up_with_the_normals_of_its_height) {
  const TriangleMesh mesh = sheet(2, 1, 40, 30, [](double x, double z) {
    return HeightAt{0.1 * std::sin(x) + 0.2 * z * z, 0.1 * std::cos(x), 0.4 * z};
  });
  EXPECT_EQ(mesh.triangles.size(), 2u * 40 * 30);
  EXPECT_EQ(count_edges(mesh.triangles).border, 2u * (40 + 30));
  EXPECT_EQ(count_edges(mesh.triangles).bad, 0u);
  EXPECT_TRUE(mesh.is_padded());
  for (const auto& t : mesh.triangles) EXPECT_GT(normal_of(mesh, t).y, 0);
  expect_smooth_normals(mesh, 2);
}

TEST(add_part, turns_and_moves_a_body) {
  TriangleMesh whole = torus(1, 0.2, 12, 8);
  const Measures one = measures_of(whole);
  add_part(whole, torus(1, 0.2, 12, 8), 90, {5, 0, 0});
  EXPECT_EQ(whole.triangles.size(), 2u * 2 * 12 * 8);
  EXPECT_NEAR(measures_of(whole).volume, 2 * one.volume, 1e-5);
  EXPECT_EQ(euler_characteristic(whole), 0);
  // x turns to -z.
  EXPECT_LT(length(Vec3d(whole.positions[96]) - Vec3d{5, 0, -1.2}), 1e-6);
  EXPECT_LT(length(Vec3d(whole.normals[96]) - Vec3d{0, 0, -1}), 1e-6);
  EXPECT_TRUE(whole.is_padded());
}

}  // namespace
}  // namespace photonproof::inline scenes_generators
