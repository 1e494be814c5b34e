// Samples of every BSDF with a smooth part against its density: a million each, over materials from all but mirrors to
// the roughest and directions from straight to all but grazing, at one level of 0.01 together.

#include <gtest/gtest.h>

#include "renderer/sphere_cells.h"
#include "renderer/test_bsdfs.h"
#include "renderer/test_shading.h"

namespace photonproof {
namespace {

using test::NamedBsdf;

bool transmits(const Bsdf& bsdf) { return std::holds_alternative<RoughDielectricBsdf<float>>(bsdf); }

TEST(bsdfs, samples_match_the_density) {
  struct Case {
    const NamedBsdf* bsdf;
    Vec3f wo;
  };
  const std::vector<NamedBsdf> bsdfs = test::white_bsdfs({1e-3, 0.15, 1.0});
  std::vector<Case> cases;
  for (const NamedBsdf& named : bsdfs)
    for (const Vec3f& wo : test::test_directions(transmits(named.bsdf))) cases.push_back({&named, wo});

  const double level = test::sidak_level(static_cast<int>(cases.size()));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [named, wo] = cases[i];
    const double p = test::sphere_p_value(
        [&](test::Random& random, Vec3f& d) {
          const float u_lobe = random.next();
          const auto drawn = test::sample(named->bsdf, wo, u_lobe, random.next2(), TransportMode::radiance);
          if (!drawn || drawn->delta) return false;
          d = drawn->wi_local;
          return true;
        },
        [&](const Vec3f& wi) { return test::pdf(named->bsdf, wo, wi); }, 1000 + i);
    EXPECT_GT(p, level) << named->name << " from " << wo.x << " " << wo.y << " " << wo.z;
  }
}

TEST(bsdfs, mirrors_have_the_mass_they_say) {
  // The share of draws that are Dirac's against the probability in them: within 5 deviations of a binomial.
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
        EXPECT_EQ(drawn->wi_local, Vec3f(-wo.x, -wo.y, wo.z)) << named.name;
      }
      EXPECT_NEAR(mirrored, samples * probability, 5 * std::sqrt(samples * probability * (1 - probability)) + 1e-9)
          << named.name;
    }
}

}  // namespace
}  // namespace photonproof
