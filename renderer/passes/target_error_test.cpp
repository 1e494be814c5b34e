// --target-error of the photon mapper: the true error of its image, against a long path-traced one, must meet the
// target. The image's own estimate includes its noise and its radii's bias, so both kinds of indirect light are tested.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_passes {
namespace {

struct Asked {
  const char* scene;
  IndirectLight indirect;
  double error;
  std::int64_t reference_spp;  ///< of each of two
  int size;                    ///< pixels a side: few pixels measure the bias poorly
};
void PrintTo(const Asked& asked, std::ostream* out) { *out << asked.scene; }

/// Two independent images; their mean is the reference.
struct Reference {
  Image a, b;

  double mean(std::size_t i) const { return (double{a.rgb[i]} + double{b.rgb[i]}) / 2; }
  /// The mean over channel values of the square of `difference`, relative as in relmse.
  template <class Difference>
  double relative_square(Difference&& difference) const {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
      const double d = difference(i);
      sum += d * d / (mean(i) * mean(i) + Film::relative_epsilon);
    }
    return sum / static_cast<double>(a.rgb.size());
  }
  double noise() const {
    return relative_square([&](std::size_t i) { return (double{a.rgb[i]} - double{b.rgb[i]}) / 2; });
  }
  double relmse(const Image& x) const {
    return relative_square([&](std::size_t i) { return double{x.rgb[i]} - mean(i); });
  }
};

class TargetError : public testing::TestWithParam<Asked> {};

TEST_P(TargetError, is_the_true_error_within_a_factor_of_one_and_a_half) {
  constexpr std::uint64_t seeds = 20, least_within = 19;
  const Asked& asked = GetParam();
  SceneDescription scene =
      parse_scene_file(std::string(PHOTONPROOF_SOURCE_DIR "/scenes/library/") + asked.scene + "/scene.xml");
  scene.sensor.film.width = scene.sensor.film.height = asked.size;
  const auto by_path = [&](std::uint64_t seed) {
    return test::render(scene, "path", test::job_with(asked.reference_spp, 0, seed)).image.mean;
  };
  const Reference reference{by_path(1001), by_path(1002)};
  const double noise = reference.noise();
  ASSERT_LT(noise, 0.2 * asked.error * asked.error);
  std::vector<double> ratios;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    RenderJob job = test::job_with(1, 0, seed);
    job.budget = {};
    job.budget.target_error = asked.error;
    const Image image = test::render(test::with_indirect(scene, asked.indirect), "photonmapper", job).image.mean;
    ratios.push_back(std::sqrt(std::max(0.0, reference.relmse(image) - noise)) / asked.error);
  }
  std::ranges::sort(ratios);
  const auto within = std::ranges::count_if(ratios, [](double r) { return r >= 1 / 1.5 && r <= 1.5; });
  std::printf("%s: true error %.2f to %.2f, median %.2f, of the %g that was asked for\n", asked.scene, ratios.front(),
              ratios.back(), ratios[seeds / 2], asked.error);
  EXPECT_GE(static_cast<std::uint64_t>(within), least_within);
}

// Automatic settings use the maps in corridor.
INSTANTIATE_TEST_SUITE_P(library, TargetError,
                         testing::Values(Asked{"cornell", IndirectLight::automatic, 0.01, 8'000, 16},
                                         Asked{"cornell", IndirectLight::map, 0.01, 8'000, 32},
                                         Asked{"corridor", IndirectLight::automatic, 0.02, 18'000, 32}),
                         [](const auto& test) {
                           return std::string(test.param.scene) +
                                  (test.param.indirect == IndirectLight::map ? "_by_maps" : "");
                         });

}  // namespace
}  // namespace photonproof::inline renderer_passes
