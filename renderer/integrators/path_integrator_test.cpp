// The path tracer against closed forms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::job_with;
using test::render;

TEST(path, furnace_is_two_at_every_pixel) {
  // L = e / (1 - rho) = 1 / (1 - 0.5) = 2 in every direction from every point of a closed surface.
  const auto out = render(test::furnace(0.5, 1, 16), "path", job_with(64));
  for (const float value : out.image.mean.rgb) EXPECT_NEAR(value, 2.0, 0.005 * 2);
}

TEST(path, furnace_cut_at_depth_k_is_the_partial_sum) {
  // Edges 1..k see the emitter after 0..k-1 bounces: e (1 + rho + ... + rho^(k-1)) = (1 - 0.5^3) / (1 - 0.5) = 1.75.
  SceneDescription scene = test::furnace(0.5, 1, 8);
  scene.integrator.method = PathDescription{3, 24, false};
  const auto out = render(scene, "path", job_with(16));
  for (const float value : out.image.mean.rgb) EXPECT_NEAR(value, 1.75, 1e-4);
}

TEST(path, roulette_leaves_the_furnace_unbiased) {
  // Roulette from the second bounce on adds noise. The mean over the image stays e / (1 - rho) = 5 within four of the
  // standard errors that the film estimates.
  SceneDescription scene = test::furnace(0.8, 1, 32);
  scene.integrator.method = PathDescription{-1, 2, false};
  const auto out = render(scene, "path", job_with(256));
  double variance = 0;
  for (const float v : out.image.variance->rgb) variance += double{v};
  const auto pixels = static_cast<double>(out.image.mean.pixels());
  const double standard_error = std::sqrt(variance / 3) / pixels;  // channels of a grey scene vary together
  EXPECT_NEAR(test::image_mean(out.image.mean), 5.0, 4 * standard_error);
  EXPECT_LT(standard_error, 0.02);
}

TEST(path, point_light_gives_cosine_over_distance_squared) {
  // E = I cos / d^2. Under the light, at height 2, E = 1/4 and L = rho E / pi. The four pixels around the centre of a
  // 64^2 image see points within 0.05 of it: cos^3 / h^2 differs from 1/4 by less than 0.1 %.
  const auto out = render(test::floor_under_point_light(64), "path", job_with(16));
  const double expected = 0.5 * 0.25 / std::numbers::pi;
  EXPECT_NEAR(test::block_mean(out.image.mean, 31, 31, 2, 2), expected, 0.001 * expected);
  EXPECT_EQ(out.stats.counts.at("rays_shadow"), 64.0 * 64 * 16);
}

TEST(path, point_lights_leave_nothing_to_weigh) {
  const auto out = render(test::floor_under_point_light(8), "path", job_with(1));
  EXPECT_THAT(out.stats.skipped, testing::Contains("mis: every light is a point, no ray can hit one"));
}

TEST(path, same_seed_gives_the_same_bits_at_1_2_and_7_threads) {
  const SceneDescription scene = test::room(40, true);
  const auto one = test::expect_same_bits_at_any_threads(scene, "path", job_with(8));
  RenderJob other = job_with(8);
  other.seed = 2;
  EXPECT_NE(one.image.mean.rgb, render(scene, "path", other).image.mean.rgb);
}

double observed_over_predicted_variance(SamplerKind sampler) {
  const SceneDescription scene = test::room(20, false);
  constexpr int seeds = 24;
  std::vector<double> sum(20 * 20 * 3), squares(20 * 20 * 3);
  double predicted = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    RenderJob job = job_with(16, 1, static_cast<std::uint64_t>(seed));
    job.sampler = sampler;
    const auto out = render(scene, "path", job);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double v = double{out.image.mean.rgb[i]};
      sum[i] += v;
      squares[i] += v * v;
      predicted += double{out.image.variance->rgb[i]} / seeds;
    }
  }
  double observed = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) observed += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
  return observed / predicted;
}

TEST(path, variance_predicts_the_spread_of_independent_renders) {
  // Over 24 seeds the sample variance of a pixel has mean Var and relative error sqrt(2/23) = 0.29. Over 20x20x3 values
  // (channels nearly vary together: 400 independent ones) the ratio's error is about 0.29/20 = 1.5 %. The skewed tail
  // of light transport adds to it. The tolerance 10 % holds easily, but not for a wrong factor of n or n-1 (at 16 spp:
  // 6 %) times K.
  EXPECT_NEAR(observed_over_predicted_variance(SamplerKind::independent), 1.0, 0.1);
}

TEST(path, variance_of_stratified_samples_is_not_underestimated) {
  // The film treats samples as independent. Scrambled Sobol points are better than that, so its estimate is an upper
  // bound.
  EXPECT_LT(observed_over_predicted_variance(SamplerKind::sobol), 1.0);
}

TEST(path, interrupt_keeps_the_first_pass) {
  const std::atomic<bool> stop{true};
  RenderJob job = job_with(1'000'000);
  job.interrupt = &stop;
  const auto out = render(test::room(16, false), "path", job);
  EXPECT_TRUE(out.stats.interrupted);
  EXPECT_EQ(out.stats.counts.at("samples_per_pixel"), 1);
  EXPECT_GT(test::image_mean(out.image.mean), 0);
  EXPECT_FALSE(out.image.variance.has_value());  // one sample gives no spread
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
