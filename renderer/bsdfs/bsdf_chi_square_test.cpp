// Chi-square test of BSDF samples against their density, for BSDFs with a smooth part. Each test takes a million
// samples. Materials range from nearly mirrors to the roughest, directions from straight to nearly grazing; the joint
// level is 0.01. Lobes of roughness 0.001 are not tested at 88 degrees: single precision has too few directions in
// lobes so narrow.

#include <gtest/gtest.h>

#include "renderer/bsdfs/test_bsdfs.h"
#include "renderer/bsdfs/test_shading.h"
#include "renderer/core/parallel.h"
#include "renderer/lanes/test_sphere_cells.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

using test::compiled;
using test::NamedBsdf;

struct Case {
  std::string name;
  Bsdf bsdf;
  double degrees;  ///< angle of wo to the normal
};

std::vector<Case> cases() {
  const RgbD one(1.0);
  std::vector<Case> all;
  all.push_back({"diffuse", compiled(DiffuseDescription{one}), 50});
  all.push_back({"difftrans", compiled(DiffuseTransmitterDescription{one}), 50});
  all.push_back({"difftrans", compiled(DiffuseTransmitterDescription{one}), 130});
  all.push_back({"plastic", compiled(PlasticDescription{one, one, 1.5, 1.0, false}), 50});
  all.push_back({"plastic", compiled(PlasticDescription{one, one, 2.4, 1.0, true}), 88});
  all.push_back({"lacquer on diffuse",
                 compiled(LayeredDescription{{0}, 1.5, 1.0, {0.2, 1, 5}, 0.5, one}, DiffuseDescription{one}), 50});
  for (const double n : {0.0, 30.0, 1e4}) {
    const PhongDescription phong{n, RgbD(0.4), RgbD(0.6)};
    all.push_back({"phong " + std::to_string(n), compiled(phong), 50});
    all.push_back({"phong " + std::to_string(n), compiled(phong), 88});
  }
  all.push_back(
      {"lacquer on phong",
       compiled(LayeredDescription{{0}, 1.5, 1.0, RgbD(0.1), 1, one}, PhongDescription{40.0, RgbD(0.6), RgbD(0.4)}),
       50});
  for (const MicrofacetDistribution d : {MicrofacetDistribution::beckmann, MicrofacetDistribution::ggx}) {
    const std::string ggx = d == MicrofacetDistribution::ggx ? "ggx " : "beckmann ";
    const auto metal = [&](double u, double v, bool visible, double degrees) {
      all.push_back({"roughconductor " + ggx + std::to_string(u) + (visible ? "" : " by area"),
                     compiled(RoughConductorDescription{d, u, v, visible, test::copper(), one}), degrees});
    };
    metal(0.001, 0.001, true, 50);
    metal(0.03, 0.03, true, 88);
    metal(1, 1, true, 88);
    metal(0.05, 0.4, true, 50);
    metal(0.03, 0.03, false, 88);
    metal(0.3, 0.3, false, 50);
    const auto glass = [&](double alpha, double eta, bool visible, double degrees) {
      all.push_back({"roughdielectric " + ggx + std::to_string(alpha) + " eta " + std::to_string(eta) +
                         (visible ? "" : " by area"),
                     compiled(RoughDielectricDescription{d, alpha, alpha, visible, eta, 1.0, one, one}), degrees});
    };
    glass(0.001, 1.5, true, 130);
    glass(0.1, 1.5, true, 0);
    glass(0.3, 1.5, true, 130);
    glass(0.3, 1 / 1.5, true, 50);
    glass(1, 2.4, true, 88);
    glass(0.1, 1.5, false, 50);
    all.push_back(
        {"roughplastic " + ggx, compiled(RoughPlasticDescription{d, 0.1, true, one, one, 1.5, 1.0, false}), 50});
    all.push_back(
        {"roughplastic " + ggx, compiled(RoughPlasticDescription{d, 0.6, true, one, one, 1.5, 1.0, false}), 88});
    all.push_back({"lacquer on roughconductor " + ggx,
                   compiled(LayeredDescription{{0}, 1.5, 1.0, RgbD(0.0), 1, one},
                            RoughConductorDescription{d, 0.15, 0.15, true, {}, one}),
                   50});
  }
  for (const auto& [alpha, degrees] : {std::pair(0.09, 50.0), {0.5, 80.0}, {0.3, 130.0}}) {
    std::vector<NamedBsdf> principled;
    test::add_principled(principled, alpha);
    for (const NamedBsdf& named : principled)
      if (degrees < 90 || lets_light_through(named.bsdf)) all.push_back({named.name, named.bsdf, degrees});
  }
  return all;
}

TEST(bsdfs, samples_match_the_density) {
  const std::vector<Case> all = cases();
  std::vector<double> p(all.size());
  Threads(0).for_each(all.size(), [&](std::size_t i) {
    const Vec3f wo = test::slanted(all[i].degrees);
    p[i] = test::sphere_p_value(
        [&](test::Random& random, Vec3f& d) {
          const float u_lobe = random.next();
          const auto drawn = test::sample(all[i].bsdf, wo, u_lobe, random.next2(), TransportMode::radiance);
          if (!drawn || drawn->delta) return false;
          d = drawn->wi_local;
          return true;
        },
        [&](const Vec3f& wi) { return test::pdf(all[i].bsdf, wo, wi); }, 1000 + i);
  });
  const double level = test::sidak_level(static_cast<int>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_GT(p[i], level) << all[i].name << " from " << all[i].degrees;
}

TEST(bsdfs, mirrors_have_the_mass_they_say) {
  // The share of Dirac samples against the probability of the Dirac lobes: within 5 deviations of a binomial.
  constexpr int samples = 100'000;
  for (const NamedBsdf& named : test::white_bsdfs({}))
    for (const Vec3f& wo : test::test_directions(false)) {
      int mirrored = 0;
      double probability = 0;
      for (std::uint64_t i = 0; i < samples; ++i) {
        test::Random random(7, i);
        const float u_lobe = random.next();
        const auto drawn = test::sample(named.bsdf, wo, u_lobe, random.next2(), TransportMode::radiance);
        if (!drawn || !drawn->delta) continue;
        ++mirrored;
        probability = static_cast<double>(drawn->pdf);
        ASSERT_EQ(drawn->wi_local, Vec3f(-wo.x, -wo.y, wo.z)) << named.name;
      }
      EXPECT_NEAR(mirrored, samples * probability, 5 * std::sqrt(samples * probability * (1 - probability)) + 1e-9)
          << named.name;
    }
}

}  // namespace
}  // namespace photonproof::inline renderer_bsdfs
