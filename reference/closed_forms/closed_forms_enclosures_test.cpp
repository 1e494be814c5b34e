#include "reference/closed_forms/closed_forms_enclosures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "scenes/base/vec.h"

namespace photonproof::inline reference_closed_forms {
namespace {

using std::numbers::pi;

TEST(ClosedForms, furnace_is_the_limit_of_its_bounces) {
  // e = 3, rho = 1/2: 3, 4.5, 5.25, ... to 6.
  EXPECT_DOUBLE_EQ(furnace(3, 0.5, 0), 3);
  EXPECT_DOUBLE_EQ(furnace(3, 0.5, 1), 4.5);
  EXPECT_DOUBLE_EQ(furnace(3, 0.5, 2), 5.25);
  EXPECT_DOUBLE_EQ(furnace(3, 0.5, 60), furnace(3, 0.5));
}

TEST(ClosedForms, integrating_sphere_balances_its_energy) {
  // The wall absorbs all flux that enters: (1 - rho) times its mean irradiance flux / (4 pi R^2) + indirect.
  const double flux = 20, albedo = 0.8, radius = 1.7, area = 4 * pi * radius * radius;
  const double total = flux / area + integrating_sphere_indirect(flux, albedo, radius);
  EXPECT_NEAR((1 - albedo) * total * area, flux, 1e-13);
}

TEST(ClosedForms, concentric_spheres_see_each_other_as_cones_say) {
  // The outer wall sees the inner ball in a cone of half-angle asin(r1/r2) straight ahead, whose projected solid angle
  // over pi is sin^2 = F21.
  const ConcentricFactors f = concentric_sphere_factors(0.4, 1);
  constexpr int n = 10'000;
  double cone = 0;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n * std::asin(0.4);
    cone += 2 * std::cos(t) * std::sin(t) * std::asin(0.4) / n;
  }
  EXPECT_NEAR(f.outer_to_inner, cone, 1e-9);
  EXPECT_EQ(f.inner_to_outer, 1);
  EXPECT_DOUBLE_EQ(f.outer_to_inner + f.outer_to_outer, 1);
}

/// Bounces light between two surfaces until nothing is left: B = sum over generations.
RadiosityPair by_bouncing(const DiffuseEmitter& a, const DiffuseEmitter& b, const ConcentricFactors& f) {
  double generation_a = a.exitance, generation_b = b.exitance;
  RadiosityPair sum{0, 0};
  for (int i = 0; i < 2000; ++i) {
    sum.first += generation_a;
    sum.second += generation_b;
    const double next_a = a.albedo * f.inner_to_outer * generation_b;
    generation_b = b.albedo * (f.outer_to_inner * generation_a + f.outer_to_outer * generation_b);
    generation_a = next_a;
  }
  return sum;
}

TEST(ClosedForms, concentric_spheres_and_planes_are_the_sum_of_their_bounces) {
  const DiffuseEmitter inner{3, 0.6}, outer{0.5, 0.9};
  const ConcentricFactors spheres = concentric_sphere_factors(0.4, 1);
  const RadiosityPair expected = by_bouncing(inner, outer, spheres);
  const RadiosityPair b = concentric_sphere_radiosity(inner, outer, spheres);
  EXPECT_NEAR(b.first, expected.first, 1e-11);
  EXPECT_NEAR(b.second, expected.second, 1e-11);

  const RadiosityPair planes_expected = by_bouncing(inner, outer, {1, 1, 0});
  const RadiosityPair planes = parallel_plane_radiosity(inner, outer);
  EXPECT_NEAR(planes.first, planes_expected.first, 1e-11);
  EXPECT_NEAR(planes.second, planes_expected.second, 1e-11);
}

/// 1/A1 int int cos cos' / (pi d^2) dA dA' between unit squares, n^4 midpoints; `other(s, t)` is a point of the second
/// one and `normal` its unit normal. The first is z = 0, normal +z.
double factor_by_quadrature(const std::function<Vec3d(double, double)>& other, const Vec3d& normal, int n) {
  const double step = 1.0 / n;
  double sum = 0;
  for (int i = 0; i < n * n; ++i)
    for (int j = 0; j < n * n; ++j) {
      const Vec3d a{(i / n + 0.5) * step, (i % n + 0.5) * step, 0};
      const Vec3d d = other((j / n + 0.5) * step, (j % n + 0.5) * step) - a;
      const double d2 = length_squared(d);
      sum += d.z * -dot(normal, d) / (pi * d2 * d2);
    }
  return sum * std::pow(step, 4);
}

TEST(ClosedForms, cube_faces_see_each_other_as_quadrature_says) {
  // The midpoint rule's error is of order step^2; two step sizes cancel it: (4 F(h) - F(2h)) / 3.
  const auto opposite = [](int n) {
    return factor_by_quadrature([](double s, double t) { return Vec3d{s, t, 1}; }, {0, 0, -1}, n);
  };
  EXPECT_NEAR(cube_factor_opposite(), (4 * opposite(40) - opposite(20)) / 3, 1e-7);
  EXPECT_NEAR(cube_factor_opposite(), 0.1998, 5e-5) << "the table's value";
  // The kernel is singular along the common edge: there the error is of the order of the step itself: 2 F(h) - F(2h).
  const auto adjacent = [](int n) {
    return factor_by_quadrature([](double s, double t) { return Vec3d{0, s, t}; }, {1, 0, 0}, n);
  };
  EXPECT_NEAR(cube_factor_adjacent(), 2 * adjacent(40) - adjacent(20), 1e-4);
  EXPECT_NEAR(cube_factor_adjacent(), 0.2000, 5e-5) << "the table's value";
}

}  // namespace
}  // namespace photonproof::inline reference_closed_forms
