// Direct light by both strategies together and by each alone.
#include "renderer/integrators/direct_integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::job_with;

test::Rendered render_direct_of(SceneDescription scene, int emitter_samples, int bsdf_samples, std::int64_t spp) {
  DirectDescription direct;
  direct.emitter_samples = emitter_samples;
  direct.bsdf_samples = bsdf_samples;
  scene.integrator.method = direct;
  RenderJob job = job_with(spp);
  job.budget.photons.reset();
  return test::render(scene, "direct", job);
}

TEST(direct, furnace_has_one_bounce_by_every_strategy) {
  // Emission and one reflection of it give e (1 + rho) = 1.5. By BSDF sampling alone there is no noise: every ray meets
  // the same radiance, and a cosine-weighted direction has the weight rho.
  const SceneDescription scene = test::furnace(0.5, 1, 16);
  for (const float v : render_direct_of(scene, 0, 1, 4).image.mean.rgb) EXPECT_NEAR(v, 1.5, 1e-5);
  for (const float v : render_direct_of(scene, 1, 1, 64).image.mean.rgb) EXPECT_NEAR(v, 1.5, 0.02 * 1.5);
  // From inside, sampling by solid angle makes the sphere uniform in area. So f cos cos' / (d^2 p) = rho / pi * (1 / 4)
  // * 4 pi = rho for every point.
  for (const float v : render_direct_of(scene, 1, 0, 64).image.mean.rgb) EXPECT_NEAR(v, 1.5, 0.02 * 1.5);
}

TEST(direct, is_the_path_tracer_cut_after_two_edges) {
  SceneDescription scene = test::room(24, true);
  scene.integrator.method = PathDescription{{2, 24, false}};
  RenderJob job = job_with(16);
  job.budget.photons.reset();
  EXPECT_EQ(test::render(scene, "path", job).image.mean.rgb, render_direct_of(scene, 1, 1, 16).image.mean.rgb);
}

TEST(direct, strategies_agree_and_mirrors_show_the_light_in_each) {
  // Means over the image within 4 standard errors by the films' estimate, an upper bound for stratified samples.
  const SceneDescription scene = test::room(24, true);
  const test::Rendered both = render_direct_of(scene, 1, 1, 4096);
  const auto standard_error = [](const Rendering& image) {
    double variance = 0;
    for (const float v : image.variance->rgb) variance += double{v};
    return std::sqrt(variance / 3) / static_cast<double>(image.mean.pixels());
  };
  for (const auto& [emitter, bsdf] : {std::pair{1, 0}, {0, 1}}) {
    const test::Rendered one = render_direct_of(scene, emitter, bsdf, 4096);
    const double tolerance = 4 * std::hypot(standard_error(both.image), standard_error(one.image));
    EXPECT_NEAR(test::image_mean(one.image.mean), test::image_mean(both.image.mean), tolerance) << emitter;
    EXPECT_LT(tolerance, 0.02 * test::image_mean(both.image.mean));
  }
}

TEST(direct, point_light_is_found_by_light_samples_alone) {
  const SceneDescription scene = test::floor_under_point_light(16);
  for (const float v : render_direct_of(scene, 0, 1, 4).image.mean.rgb) EXPECT_EQ(v, 0);
  // E = I cos / d^2 = 1/4 under the light at height 2, L = rho E / pi. The middle four of 64 pixels see points so near
  // to it that E varies by less than 0.1 %.
  const auto out = render_direct_of(test::floor_under_point_light(64), 1, 0, 16);
  const double expected = 0.5 * 0.25 / std::numbers::pi;
  EXPECT_NEAR(test::block_mean(out.image.mean, 31, 31, 2, 2), expected, 0.001 * expected);
}

TEST(direct, counts_multiply_the_samples_taken) {
  const SceneDescription scene = test::room(16, false);
  const auto four = render_direct_of(scene, 4, 1, 8);
  EXPECT_EQ(four.stats.counts.at("samples_per_pixel"), 8);
  EXPECT_EQ(four.stats.counts.at("paths_per_sample"), 4);
  EXPECT_EQ(four.stats.counts.at("rays_camera"), 16 * 16 * 8 * 4);
  EXPECT_EQ(four.image.mean.rgb, render_direct_of(scene, 1, 1, 32).image.mean.rgb);
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
