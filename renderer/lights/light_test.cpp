// Every light: irradiance in closed form, sampled density, emitted flux.

#include "renderer/lights/light.h"

#include <gtest/gtest.h>

#include "renderer/kernels/direct_light.h"
#include "renderer/lanes/test_chi_square.h"

namespace photonproof::inline renderer_lights {
namespace {

Light square(float half, float height) {
  // Faces down from y = height.
  return QuadLight<float>{{-half, height, -half}, {2 * half, 0, 0}, {0, 0, 2 * half}, {0, -1, 0},
                          4 * half * half,        Rgb(1),           told_by_corner};
}

/// Irradiance at p with normal n by sampling the light, mean over `samples`.
double irradiance(const Light& light, const Vec3f& p, const Vec3f& n, int samples) {
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    test::Random s(31, static_cast<std::uint64_t>(i));
    const LightSample<float> drawn = sample(light, p, s.next2());
    if (drawn.pdf > 0) sum += static_cast<double>(drawn.radiance.x * std::max(0.0f, dot(n, drawn.wi)) / drawn.pdf);
  }
  return sum / samples;
}

TEST(point_light, irradiance_is_intensity_cosine_over_distance_squared) {
  // Height 3, 4 to the side: d = 5, cos = 3/5: 10 * 0.6 / 25 = 0.24.
  EXPECT_NEAR(irradiance(PointLight<float>{{4, 3, 0}, Rgb(10)}, {0, 0, 0}, {0, 1, 0}, 1), 0.24, 1e-6);
}

TEST(quad_light, irradiance_is_the_parallel_rectangle_form) {
  // Under the centre: four times the corner form F(X,Y), X = Y = half/height = 0.5.
  //   `F = (1/2pi) 2 X/sqrt(1+X^2) atan(X/sqrt(1+X^2)) = 0.0598..., E = pi L 4 F`.
  const double x = 0.5, a = x / std::sqrt(1 + x * x);
  const double form = 2 * a * std::atan(a) / (2 * std::numbers::pi);
  const double expected = std::numbers::pi * 4 * form;
  EXPECT_NEAR(irradiance(square(1, 2), {0, 0, 0}, {0, 1, 0}, 200'000), expected, 0.002 * expected);
}

TEST(mis, weights_stay_finite_beside_lights_of_no_size) {
  EXPECT_EQ(mis_weight(1e30f, 1.0f), 1);
  EXPECT_EQ(mis_weight(1.0f, 1e30f), 0);
  EXPECT_EQ(mis_weight(1e30f, 1e30f), 0.5f);
  EXPECT_EQ(mis_weight(0.0f, 1.0f), 0);
  EXPECT_NEAR(mis_weight(3.0f, 4.0f), 9.0f / 25, 1e-7f);
}

TEST(quad_light, gives_nothing_behind_itself) { EXPECT_EQ(irradiance(square(1, 2), {0, 3, 0}, {0, -1, 0}, 100), 0); }

TEST(sphere_light, irradiance_is_pi_l_sin_squared) {
  // The whole sphere is above the horizon: E = pi L (R/d)^2 cos. Overhead at distance 2 with R = 1 that is pi/4; the
  // other point almost touches.
  const Light light = SphereLight<float>{{0, 2, 0}, 1, 1, Rgb(1)};
  EXPECT_NEAR(irradiance(light, {0, 0, 0}, {0, 1, 0}, 100'000), std::numbers::pi / 4, 0.002);
  EXPECT_NEAR(irradiance(light, {0, 0.99f, 0}, {0, 1, 0}, 400'000), std::numbers::pi / (1.01 * 1.01), 0.01);
  EXPECT_NEAR(irradiance(light, {0, -1e4f, 0}, {0, 1, 0}, 1000), std::numbers::pi / (10002.0 * 10002.0), 1e-11);
}

TEST(sphere_light, from_inside_irradiance_is_pi_l_everywhere) {
  const Light light = SphereLight<float>{{0, 0, 0}, 1, -1, Rgb(1)};
  for (const Vec3f p : {Vec3f(0, 0, 0), Vec3f(0.5f, 0.2f, -0.3f), Vec3f(0, 0, 0.9f)})
    EXPECT_NEAR(irradiance(light, p, {0, 0, -1}, 200'000), std::numbers::pi, 0.03) << p.z;
  // On the wall itself every sample has the same value: cos cos' / d^2 = 1/(4 R^2).
  EXPECT_NEAR(irradiance(light, {0, 0, 1}, {0, 0, -1}, 1000), std::numbers::pi, 0.001);
}

TEST(sphere_light, points_drawn_are_where_the_direction_meets_the_sphere_first) {
  // At every distance a shadow ray to the point must go along wi and end on the near side. Errors of wi and of the
  // direction to the centre are a few 2^-24. Across a distance d the ray may be off by as much.
  for (const float distance : {1.1f, 10.0f, 1e4f, 1e5f}) {
    const Light light = SphereLight<float>{{0, 0, 0}, 1, 1, Rgb(1)};
    const Vec3f p = Vec3f(0.48f, -0.6f, 0.64f) * distance;
    for (std::uint64_t i = 0; i < 10'000; ++i) {
      const LightSample<float> drawn = sample(light, p, test::Random(36, i).next2());
      EXPECT_NEAR(length(drawn.at.normal), 1, 1e-3f);
      EXPECT_NEAR(length(drawn.at.p - drawn.at.normal), 0, 1e-6f);
      EXPECT_LT(dot(drawn.at.normal, drawn.wi), 0.01f);
      // The distance of point and ray from the line through p and the centre, in double.
      const Vec3d axis = normalize(Vec3d(p)), wi(drawn.wi), n(drawn.at.normal);
      const Vec3d ray_across = wi - axis * dot(wi, axis), point_across = n - axis * dot(n, axis);
      const double reach = length(Vec3d(drawn.at.p) - Vec3d(p));
      ASSERT_NEAR(length(ray_across) * reach, length(point_across), 1e-3 + 0x1p-21 * double{distance}) << distance;
    }
  }
}

TEST(surface_lights, sampled_directions_match_their_density) {
  // Directions towards the light from a fixed point; the density of one that misses it is 0. Cells cut by the light's
  // outline are integrated on an 8x8 lattice; for these large lights its error is below what the test detects.
  const Light ball = SphereLight<float>{{0, 0, 1.5f}, 1.2f, 1, Rgb(1)};
  const Vec3f p(0, 0, 0);
  const double p_value = test::direction_p_value([&](test::Random& s) { return sample(ball, p, s.next2()).wi; },
                                                 [&](const Vec3f& d) { return d.z > 0.6f ? pdf(ball, p, {}) : 0; },
                                                 32);  // sin = 1.2/1.5, cos = 0.6
  EXPECT_GT(p_value, test::sidak_level(2));

  const Light shell = SphereLight<float>{{0, 0, 0}, 1, -1, Rgb(1)};
  const Vec3f inside(0.3f, -0.2f, 0.4f);
  const double shell_p = test::direction_p_value([&](test::Random& s) { return sample(shell, inside, s.next2()).wi; },
                                                 [&](const Vec3f& d) {
                                                   const float b = dot(d, inside);
                                                   const float t = -b + std::sqrt(b * b + 1 - dot(inside, inside));
                                                   const Vec3f hit = inside + d * t;
                                                   return pdf(shell, inside, {hit, -hit});
                                                 },
                                                 33);
  EXPECT_GT(shell_p, test::sidak_level(2));
}

TEST(lights, photons_leave_with_the_lights_flux_and_pattern) {
  // Quad: cosine about its normal; point: uniform. Flux: pi L A = 4 pi, pi L 4 pi R^2, 4 pi I.
  const Light quad = QuadLight<float>{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, 4, Rgb(1), told_by_corner};
  EXPECT_NEAR(flux(quad).x, 4 * pi, 1e-5f);
  EXPECT_NEAR(flux(Light(SphereLight<float>{{0, 0, 0}, 2, 1, Rgb(1)})).x, pi * 16 * pi, 1e-3f);
  EXPECT_NEAR(flux(Light(PointLight<float>{{}, Rgb(3)})).x, 12 * pi, 1e-4f);
  EXPECT_GT(test::direction_p_value(
                [&](test::Random& s) {
                  const auto u = s.next2();
                  return emit(quad, u, s.next2()).direction;
                },
                [](const Vec3f& d) { return cosine_hemisphere_pdf(d.z); }, 34),
            test::sidak_level(2));
  EXPECT_GT(test::direction_p_value(
                [&](test::Random& s) {
                  return emit(Light(PointLight<float>{{}, Rgb(1)}), {}, s.next2()).direction;
                },
                [](const Vec3f&) { return 1 / (4 * pi); }, 35),
            test::sidak_level(2));
}

// Flux over intensity of a cone whose falloff is linear from b to c. The reference is Simpson's rule on sin(t) times
// the falloff, which shares nothing with the closed form. For narrow cones it is the limit pi (c^2 + b c + b^2) / 3,
// off by c^2 / 10.
TEST(spot_light, flux_is_that_of_its_cone_down_to_the_narrowest) {
  const auto flux_of = [](double beam, double cutoff) {
    return double{flux(Light(spot_light({}, {0, 0, 1}, Rgb(1), beam, cutoff))).x};
  };
  for (const double cutoff : {1.5, 0.7, 0.1, 0.015, 0.005})
    for (const double share : {0.0, 0.5, 0.75, 0.999}) {
      const double beam = share * cutoff, step = (cutoff - beam) / 1000;
      double ramp = 0;
      for (int i = 0; i <= 1000; ++i)
        ramp += (i == 0 || i == 1000 ? 1
                 : i % 2 == 1        ? 4
                                     : 2) *
                std::sin(beam + i * step) * (1 - i / 1000.0) * step / 3;
      const double in_full = 2 * std::pow(std::sin(beam / 2), 2), expected = 2 * pi_d * (in_full + ramp);
      EXPECT_NEAR(flux_of(beam, cutoff), expected, 1e-6 * expected) << beam << " " << cutoff;
    }
  for (const double cutoff : {1e-4, 1e-6, 1e-8, 1e-10, 1e-14})
    for (const double share : {0.0, 0.5, 1.0}) {
      const double beam = share * cutoff, expected = pi_d * (cutoff * cutoff + beam * cutoff + beam * beam) / 3;
      EXPECT_NEAR(flux_of(beam, cutoff), expected, 1e-6 * expected) << beam << " " << cutoff;
    }
}

// A cylinder of any size, however tiny, is sampled alike: the density times the area stays.
TEST(cylinder_light, is_sampled_alike_down_to_the_smallest) {
  const auto density_times_area = [](float size) {
    const CylinderShape area_light{{1, 5, -1}, {0, 0, size}, {1, 0, 0}, {0, 1, 0}, size, 1};
    return double{area_light.sample_from({0, 0, 0}, {0.3f, 0.6f}).pdf} * double{size} * double{size};
  };
  for (const float size : {1e-6f, 1e-9f, 1e-12f, 1e-15f})
    EXPECT_NEAR(density_times_area(size) / density_times_area(1e-4f), 1, 1e-3) << size;
}

}  // namespace
}  // namespace photonproof::inline renderer_lights
