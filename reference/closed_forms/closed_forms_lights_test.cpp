#include "reference/closed_forms/closed_forms_lights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace photonproof::inline reference_closed_forms {
namespace {

using std::numbers::pi;

using Rectangle = std::array<Vec3d, 4>;

/// E = L int cos cos' / d^2 dA by the midpoint rule: of order 1/n^2, here with n = 1000 below 1e-6 relative.
double by_quadrature(double radiance, const Rectangle& light, const SurfacePoint& at) {
  constexpr int n = 1000;
  const Vec3d u = light[1] - light[0];
  const Vec3d v = light[3] - light[0];
  const Vec3d area_normal = cross(u, v);
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3d d = light[0] + u * ((i + 0.5) / n) + v * ((j + 0.5) / n) - at.position;
      const double d2 = length_squared(d);
      sum += std::max(0.0, dot(at.normal, d)) * std::max(0.0, -dot(area_normal, d)) / (d2 * d2);
    }
  return radiance * sum / (double{n} * n);
}

// Facing down (-y): counter-clockwise seen from below.
const Rectangle ceiling{{{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}};

TEST(ClosedForms, point_light_follows_the_inverse_square_and_cosine) {
  // I = 20 from height 3 to a point 4 aside: d = 5, cos = 3/5, E = 20 (3/5) / 25 = 0.48.
  EXPECT_DOUBLE_EQ(irradiance_of_point(20, {4, 3, 0}, {{0, 0, 0}, {0, 1, 0}}), 0.48);
  EXPECT_EQ(irradiance_of_point(20, {4, -3, 0}, {{0, 0, 0}, {0, 1, 0}}), 0) << "from behind";
}

TEST(ClosedForms, polygon_agrees_with_quadrature_where_all_of_it_is_above_the_horizon) {
  for (const SurfacePoint& at : {SurfacePoint{{0, 0, 0}, {0, 1, 0}}, SurfacePoint{{3, 0, -1}, {0, 1, 0}},
                                 SurfacePoint{{0.5, 1, 0.2}, normalize(Vec3d{0.2, 1, -0.1})}}) {
    const double expected = by_quadrature(7, ceiling, at);
    EXPECT_NEAR(irradiance_of_polygon(7, ceiling, at), expected, 2e-6 * expected);
  }
}

TEST(ClosedForms, polygon_is_clipped_at_the_horizon) {
  // A wall's point: its normal +x leaves the half of the light with x < 0 behind. The kink costs quadrature one order.
  const SurfacePoint at{{0, 0, 0.3}, {1, 0, 0}};
  const double expected = by_quadrature(7, ceiling, at);
  EXPECT_NEAR(irradiance_of_polygon(7, ceiling, at), expected, 1e-5 * expected);
}

// Prisms of n sides, inscribed in the tube and around it, have errors of order 1/n^2 in the ratio 1 : -2.
TEST(ClosedForms, cylinder_is_the_limit_of_prisms) {
  const Vec3d p0{-0.4, 2.5, 0}, p1{0.6, 2.2, 0.3};
  const SurfacePoint at{{0.8, 0, -0.6}, normalize(Vec3d{0.1, 1, 0.2})};
  constexpr double radius = 0.3;
  const Vec3d axis = normalize(p1 - p0), u = normalize(cross(axis, {0, 1, 0})), v = cross(axis, u);
  const auto of_prism = [&](double r, int n) {
    const auto corner = [&](const Vec3d& end, int i) {
      return end + (u * std::cos(2 * pi * i / n) + v * std::sin(2 * pi * i / n)) * r;
    };
    double sum = 0;
    for (int i = 0; i < n; ++i)
      sum +=
          irradiance_of_polygon(7, Rectangle{corner(p0, i), corner(p0, i + 1), corner(p1, i + 1), corner(p1, i)}, at);
    return sum;
  };
  constexpr int sides = 3000;
  const double inner = of_prism(radius, sides), outer = of_prism(radius / std::cos(pi / sides), sides);
  const double expected = (2 * inner + outer) / 3;
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(irradiance_of_cylinder(7, p0, p1, radius, at), expected, 3e-6 * expected);
}

TEST(ClosedForms, polygon_shines_on_one_side_and_only_above_the_horizon) {
  EXPECT_EQ(irradiance_of_polygon(7, ceiling, {{0, 3, 0}, {0, -1, 0}}), 0) << "behind the light";
  EXPECT_EQ(irradiance_of_polygon(7, ceiling, {{0, 0, 0}, {0, -1, 0}}), 0) << "facing away";
}

TEST(ClosedForms, corner_form_is_the_polygon_with_a_corner_overhead) {
  const Rectangle light{{{0, 2, 0}, {3, 2, 0}, {3, 2, 1.5}, {0, 2, 1.5}}};
  const double expected = irradiance_of_rectangle_corner(7, 3, 1.5, 2);
  EXPECT_NEAR(irradiance_of_polygon(7, light, {{0, 0, 0}, {0, 1, 0}}), expected, 1e-14 * expected);
  // An infinite quarter plane covers a quarter of the hemisphere's projected solid angle pi.
  EXPECT_NEAR(irradiance_of_rectangle_corner(7, 1e9, 1e9, 1), 7 * pi / 4, 1e-7);
}

TEST(ClosedForms, sphere_far_away_is_a_point_of_intensity_pi_R2_L) {
  const SurfacePoint at{{0, 0, 0}, {0, 1, 0}};
  EXPECT_DOUBLE_EQ(irradiance_of_sphere(5, {30, 40, 0}, 2, at), irradiance_of_point(5 * pi * 4, {30, 40, 0}, at));
}

TEST(ClosedForms, sphere_agrees_with_quadrature_over_its_cone) {
  // E = L int cos dw over the cone of half-angle asin(R/d) around the direction at angle t to the normal. In the cone's
  // own polar coordinates (a, phi) the cosine to the normal is cos a cos t + sin a sin t cos phi.
  const Vec3d center{1, 3, 0.5};
  const double radius = 0.8;
  const double d = length(center);
  const double cos_t = center.y / d;
  const double sin_t = std::sqrt(1 - cos_t * cos_t);
  constexpr int n = 1000;
  const double widest = std::asin(radius / d);
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = (i + 0.5) / n * widest;
      const double phi = (j + 0.5) / n * 2 * pi;
      sum += (std::cos(a) * cos_t + std::sin(a) * sin_t * std::cos(phi)) * std::sin(a);
    }
  const double expected = 5 * sum * widest * 2 * pi / (double{n} * n);
  EXPECT_NEAR(irradiance_of_sphere(5, center, radius, {{0, 0, 0}, {0, 1, 0}}), expected, 1e-6 * expected);
}

TEST(ClosedForms, spot_is_the_point_light_within_its_beam_and_falls_linearly_to_its_cutoff) {
  // Straight down from height 2: a floor point at the angle t is 2 tan t aside, E = I falloff(t) cos^3 t / 4.
  const auto at_angle = [](double t) {
    return irradiance_of_spot(12, {0, 2, 0}, {0, -1, 0}, {0.2, 0.6}, {{2 * std::tan(t), 0, 0}, {0, 1, 0}});
  };
  const auto full = [](double t) { return 3 * std::pow(std::cos(t), 3); };
  EXPECT_NEAR(at_angle(0.1), full(0.1), 1e-14);
  EXPECT_NEAR(at_angle(0.3), 0.75 * full(0.3), 1e-14);
  EXPECT_NEAR(at_angle(0.5), 0.25 * full(0.5), 1e-14);
  EXPECT_EQ(at_angle(0.61), 0);
}

TEST(ClosedForms, beam_follows_the_cosine) {
  // cos 60 degrees = 1/2.
  EXPECT_NEAR(irradiance_of_beam(7, {std::sqrt(0.75), -0.5, 0}, {0, 1, 0}), 3.5, 1e-14);
  EXPECT_EQ(irradiance_of_beam(7, {0, 1, 0}, {0, 1, 0}), 0) << "from behind";
}

TEST(ClosedForms, uniform_sky_is_an_endless_ceiling) {
  const double e = 1e6;
  const Rectangle endless{{{-e, 1, -e}, {e, 1, -e}, {e, 1, e}, {-e, 1, e}}};
  EXPECT_NEAR(irradiance_of_uniform_sky(7), irradiance_of_polygon(7, endless, {{0, 0, 0}, {0, 1, 0}}), 1e-4);
}

TEST(ClosedForms, parallel_disc_is_the_limit_of_polygons) {
  // An inscribed regular n-gon lacks the part 1 - sin(2 pi/n) n / (2 pi) = (2 pi/n)^2 / 6 of the area: 2.6e-6 here.
  constexpr int n = 1600;
  std::vector<Vec3d> outline;
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * pi * i / n;
    outline.push_back({0.7 * std::cos(phi), 1.5, 0.7 * std::sin(phi)});
  }
  for (const double offset : {0.0, 0.4, 0.7, 3.0}) {
    const double expected = irradiance_of_polygon(7, outline, {{offset, 0, 0}, {0, 1, 0}});
    EXPECT_NEAR(irradiance_of_parallel_disc(7, 0.7, 1.5, offset), expected, 5e-6 * expected) << offset;
  }
  EXPECT_NEAR(irradiance_of_parallel_disc(7, 0.7, 1.5, 0), 7 * pi * 0.49 / (0.49 + 2.25), 1e-13) << "on the axis";
}

}  // namespace
}  // namespace photonproof::inline reference_closed_forms
