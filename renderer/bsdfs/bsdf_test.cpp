// Tests of every BSDF: density, energy, reciprocity, and the laws of optics.

#include "renderer/bsdfs/bsdf.h"

#include <gtest/gtest.h>

#include "renderer/bsdfs/test_shading.h"
#include "renderer/lanes/test_chi_square.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

using test::eval;
using test::pdf;
using test::sample;

Vec3f direction(double theta_degrees) {
  const double theta = theta_degrees * std::numbers::pi / 180;
  return {static_cast<float>(std::sin(theta)), 0, static_cast<float>(std::cos(theta))};
}

TEST(diffuse, samples_match_the_density) {
  const Bsdf bsdf = DiffuseBsdf<float>{Rgb(0.5f)};
  int test_number = 0;
  for (const double theta : {0.0, 45.0, 89.9}) {
    const Vec3f wo = direction(theta);
    EXPECT_GT(
        test::direction_p_value(
            [&](test::Random& s) { return sample(bsdf, wo, s.next(), s.next2(), TransportMode::radiance)->wi_local; },
            [&](const Vec3f& wi) { return pdf(bsdf, wo, wi); }, static_cast<std::uint64_t>(20 + test_number++)),
        test::sidak_level(3));
  }
}

TEST(diffuse, weight_is_albedo_and_agrees_with_eval_over_pdf) {
  const Bsdf bsdf = DiffuseBsdf<float>{{0.2f, 0.5f, 0.9f}};
  const Vec3f wo = direction(30);
  for (std::uint64_t i = 0; i < 100; ++i) {
    test::Random s(21, i);
    const auto drawn = sample(bsdf, wo, s.next(), s.next2(), TransportMode::radiance);
    ASSERT_TRUE(drawn);
    const Rgb ratio = eval(bsdf, wo, drawn->wi_local) * (drawn->wi_local.z / drawn->pdf);
    EXPECT_NEAR(ratio.x, 0.2f, 1e-6f);
    EXPECT_NEAR(ratio.z, drawn->weight.z, 1e-6f);
  }
}

TEST(diffuse, is_reciprocal_and_black_from_behind) {
  const Bsdf bsdf = DiffuseBsdf<float>{Rgb(0.5f)};
  const Vec3f a = direction(20), b = direction(-70);
  EXPECT_EQ(eval(bsdf, a, b).x, eval(bsdf, b, a).x);
  const Vec3f below{a.x, a.y, -a.z};
  EXPECT_EQ(eval(bsdf, below, b).x, 0);
  EXPECT_EQ(eval(bsdf, a, below).x, 0);
  EXPECT_FALSE(sample(bsdf, below, 0.5f, {0.5f, 0.5f}, TransportMode::radiance));
}

TEST(fresnel, normal_incidence_brewster_and_total_reflection) {
  // R(0) = ((n-1)/(n+1))^2 = 0.04 for n = 1.5. At Brewster's angle atan(n) the parallel part vanishes and
  // R = ((n^2-1)/(n^2+1))^2 / 2 = (1.25/3.25)^2 / 2 = 0.0739645. Beyond asin(1/n) = 41.81 degrees inside, R = 1.
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f).reflectance, 0.04f, 1e-6f);
  const float cos_brewster = 1 / std::sqrt(1 + 1.5f * 1.5f);
  EXPECT_NEAR(fresnel_dielectric(cos_brewster, 1.5f).reflectance, 0.0739645f, 1e-6f);
  EXPECT_EQ(fresnel_dielectric(std::cos(41.82f * pi / 180), 1 / 1.5f).reflectance, 1);
  EXPECT_LT(fresnel_dielectric(std::cos(41.80f * pi / 180), 1 / 1.5f).reflectance, 1);
  EXPECT_NEAR(fresnel_dielectric(0.0f, 1.5f).reflectance, 1, 1e-6f);
}

TEST(fresnel, is_the_same_from_both_sides_of_the_interface) {
  for (float cos_outside = 0.05f; cos_outside <= 1; cos_outside += 0.05f) {
    const DielectricFresnel<float> in = fresnel_dielectric(cos_outside, 1.5f);
    EXPECT_NEAR(in.reflectance, fresnel_dielectric(in.cos_transmit, 1 / 1.5f).reflectance, 1e-5f);
  }
}

TEST(fresnel, conductor_has_its_closed_form_at_normal_incidence_and_the_dielectric_limit) {
  // R(0) = ((n-1)^2 + k^2) / ((n+1)^2 + k^2): gold's red, n = 0.143, k = 3.983: (0.7344+15.864)/(1.3064+15.864) =
  // 0.96669.
  EXPECT_NEAR(fresnel_conductor(1.0f, 0.143f, 3.983f), 0.96669f, 1e-4f);
  for (float c = 0.1f; c <= 1; c += 0.1f)
    EXPECT_NEAR(fresnel_conductor(c, 1.5f, 0.0f), fresnel_dielectric(c, 1.5f).reflectance, 1e-5f);
}

TEST(conductor, mirrors_about_the_normal_and_absorbs_from_behind) {
  const Bsdf bsdf = ConductorBsdf<float>{{0.9f, 0.8f, 0.7f}, 0, {}, {}};
  const auto drawn = sample(bsdf, {0.6f, 0, 0.8f}, 0.3f, {0.1f, 0.9f}, TransportMode::radiance);
  ASSERT_TRUE(drawn);
  EXPECT_TRUE(drawn->delta);
  EXPECT_FALSE(has_smooth(bsdf));
  EXPECT_EQ(drawn->wi_local, Vec3f(-0.6f, 0, 0.8f));
  EXPECT_EQ(drawn->weight, Rgb(0.9f, 0.8f, 0.7f));
  EXPECT_FALSE(sample(bsdf, {0.6f, 0, -0.8f}, 0.3f, {0.1f, 0.9f}, TransportMode::radiance));
}

TEST(dielectric, refracts_by_snells_law_both_ways) {
  const Bsdf bsdf = DielectricBsdf<float>{1.5f, Rgb(1), Rgb(1)};
  for (const float side : {1.0f, -1.0f}) {
    const Vec3f wo{0.3f, 0.4f, side * std::sqrt(0.75f)};
    const auto drawn = sample(bsdf, wo, 0.9999f, {}, TransportMode::importance);
    ASSERT_TRUE(drawn);
    const float ratio = side > 0 ? 1.5f : 1 / 1.5f;
    EXPECT_LT(drawn->wi_local.z * side, 0);
    EXPECT_NEAR(length(drawn->wi_local), 1, 1e-6f);
    EXPECT_NEAR(std::hypot(drawn->wi_local.x, drawn->wi_local.y) * ratio, 0.5f, 1e-6f);
    EXPECT_NEAR(drawn->eta, ratio, 1e-6f);
  }
}

TEST(dielectric, conserves_energy_at_every_angle_up_to_grazing) {
  // Probability-weighted weights of the two lobes sum to 1 for flux, whatever the angle and the side.
  const Bsdf bsdf = DielectricBsdf<float>{1.8f, Rgb(1), Rgb(1)};
  for (const double theta : {0.0, 30.0, 60.0, 89.0, 89.999, 91.0, 120.0, 150.0, 180.0}) {
    const Vec3f wo = direction(theta);
    const auto reflected = sample(bsdf, wo, 0.0f, {}, TransportMode::importance);
    const auto other = sample(bsdf, wo, std::nextafter(1.0f, 0.0f), {}, TransportMode::importance);
    double energy = static_cast<double>(reflected->pdf * reflected->weight.x);
    if (other->eta != 1) energy += static_cast<double>(other->pdf * other->weight.x);
    EXPECT_NEAR(energy, 1, 1e-6) << theta;
  }
}

TEST(dielectric, radiance_scales_by_the_squared_index_and_comes_back) {
  const Bsdf bsdf = DielectricBsdf<float>{1.5f, Rgb(1), Rgb(1)};
  const auto in = sample(bsdf, direction(30), 0.999f, {}, TransportMode::radiance);
  const auto out = sample(bsdf, {-in->wi_local.x, 0, in->wi_local.z}, 0.999f, {}, TransportMode::radiance);
  EXPECT_NEAR(in->weight.x, 1 / 2.25f, 1e-6f);
  EXPECT_NEAR(in->weight.x * out->weight.x, 1, 1e-6f);
}

}  // namespace
}  // namespace photonproof::inline renderer_bsdfs
