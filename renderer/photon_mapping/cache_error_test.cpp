// The photon mapper's estimate of its irradiance cache's error, against long path renders. Also renders that are to
// continue until their error is below that.

#include "renderer/irradiance/cache_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

TEST(cache_error, is_the_mean_of_products_relative_to_the_image_and_weighted) {
  Film film(2, 1);
  film.add(0, 0, RgbD{1, 2, 0}, 1);
  film.add(1, 0, RgbD(0.3), 1);
  // (.02/1.01 + .08/4.01 + .001/.01)/3/4 + (3 * .01/.1)/3 * 3/4
  const CacheError error({{0, 0, 0.25, {0.02, 0.08, 0.001}}, {1, 0, 0.75, RgbD(0.01)}});
  const double first = (0.02 / 1.01 + 0.08 / 4.01 + 0.1) / 12;
  EXPECT_NEAR(error.squared_bias(film), first + 0.075, 1e-12);
  EXPECT_EQ(CacheError({{0, 0, 1, RgbD(-0.1)}}).squared_bias(film), 0) << "noise alone";
  EXPECT_EQ(CacheError().squared_bias(film), 0);
}

RenderJob job_of_cache(std::int64_t spp, std::uint64_t seed) {
  RenderJob job = test::job_with(spp, 0, seed);
  job.budget.photons.reset();
  job.sampler = SamplerKind::independent;  // so that variances are unbiased
  return job;
}

/// Squared bias of the image as relmse, without the part that the variances of both images explain.
double squared_bias_of(const Rendering& image, const Rendering& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.mean.rgb.size(); ++i) {
    const double is = double{image.mean.rgb[i]}, ought = double{truth.mean.rgb[i]};
    const double noise = double{image.variance->rgb[i]} + double{truth.variance->rgb[i]};
    sum += ((is - ought) * (is - ought) - noise) / (ought * ought + Film::relative_epsilon);
  }
  return sum / static_cast<double>(truth.mean.rgb.size());
}

/// Compares the root mean square over caches of some seeds.
void expect_honest_claim(const char* name, const SceneDescription& scene) {
  constexpr int seeds = 6;
  const Rendering truth = test::render(scene, "path", job_of_cache(8192, 99)).image;
  double is = 0, claimed = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto out = test::render(test::with_indirect(scene, IndirectLight::cache), "photonmapper",
                                  job_of_cache(512, static_cast<std::uint64_t>(seed)));
    const double claim = out.stats.counts.at("relative_bias_cache");
    EXPECT_LE(claim, out.stats.counts.at("relative_bias") * (1 + 1e-12));
    claimed += claim * claim / seeds;
    is += squared_bias_of(out.image, truth) / seeds;
  }
  std::printf("%s: bias %.4f, claimed %.4f\n", name, std::sqrt(is), std::sqrt(claimed));
  EXPECT_GT(std::sqrt(claimed), std::sqrt(is) / 1.5);
  EXPECT_LT(std::sqrt(claimed), std::sqrt(is) * 1.5);
}

/// Under the light hangs a plate twice as wide, black above: only the walls light the area that it shades.
SceneDescription room_behind_plate(int size) {
  SceneDescription scene = test::room(size, false);
  test::add_shape(scene, RectangleDescription{},
                  Transform::translate({0, 0.6, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(0.5)),
                  {0});
  return scene;
}

TEST(cache_error, of_a_diffuse_room_is_what_is_claimed) { expect_honest_claim("room", test::room(32, false)); }
TEST(cache_error, of_a_room_with_balls_is_what_is_claimed) { expect_honest_claim("balls", test::room(32, true)); }
TEST(cache_error, of_a_room_behind_a_plate_is_what_is_claimed) { expect_honest_claim("plate", room_behind_plate(32)); }

TEST(cache_error, ends_a_render_that_cannot_be_as_good_as_asked_for_and_says_so) {
  const SceneDescription scene = test::with_indirect(test::room(32, false), IndirectLight::cache);
  RenderJob job = job_of_cache(1, 1);
  job.budget = {};
  job.budget.target_error = 0.001;
  const auto out = test::render(scene, "photonmapper", job);
  const auto& counts = out.stats.counts;
  const double lasting = counts.at("relative_bias_cache"), bias = counts.at("relative_bias"),
               noise = counts.at("relative_standard_error");
  EXPECT_GT(lasting, 0.001);
  EXPECT_LE(bias * bias + noise * noise, 1.25 * lasting * lasting);
  EXPECT_GT(noise, 0.001 / 4) << "it went on for long";
  char text[200];
  std::snprintf(text, sizeof text,
                "--target-error 0.001 is not reached, the error is %.3g: %.3g of it is what the irradiance cache has "
                "wrong, and does not fall with more samples",
                std::sqrt(bias * bias + noise * noise), lasting);
  EXPECT_THAT(out.stats.losses, testing::ElementsAre(text));

  job.budget.target_error = 0.1;
  const auto easy = test::render(scene, "photonmapper", job);
  EXPECT_TRUE(easy.stats.losses.empty());
  EXPECT_LE(std::hypot(easy.stats.counts.at("relative_bias"), easy.stats.counts.at("relative_standard_error")), 0.1);
}

TEST(cache_error, radii_that_a_scene_fixes_end_a_render_likewise) {
  const SceneDescription scene = test::with_indirect(test::room(32, false), IndirectLight::map, 0.5);
  RenderJob job = job_of_cache(1, 1);
  job.budget = {};
  job.budget.target_error = 0.001;
  const auto out = test::render(scene, "photonmapper", job);
  EXPECT_LT(out.stats.counts.at("samples_per_pixel"), 10'000);
  ASSERT_EQ(out.stats.losses.size(), 1u);
  EXPECT_THAT(out.stats.losses[0], testing::HasSubstr("of it is what the radii that the scene fixes have wrong"));
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
