// The photon mapper with path tracing between diffuse surfaces, with and without a caustic map. References are closed
// forms and the path tracer, which finds caustics by rays that meet the light. aovs_test.cpp checks that the views add
// up.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::job_with;
using test::render;

SceneDescription traced_on(const SceneDescription& scene) { return test::with_indirect(scene, IndirectLight::path); }

TEST(path_beside_caustics, depth_counts_every_edge) {
  // Emission and k - 1 bounces of albedo 1/2: 1, 1.5, 1.75, 1.875, with the limit 2.
  const double expected[] = {1, 1.5, 1.75, 1.875, 2};
  for (int depth = 1; depth <= 5; ++depth) {
    SceneDescription scene = test::furnace(0.5, 1, 16);
    scene.integrator.method = PathDescription{depth < 5 ? depth : -1, 24, false};
    const auto out = render(traced_on(scene), "photonmapper", job_with(64));
    EXPECT_NEAR(test::image_mean(out.image.mean), expected[depth - 1], 0.001 * expected[depth - 1]) << depth;
    EXPECT_EQ(out.stats.counts.count("photons_emitted_global"), 0);
  }
}

/// Means of the image and of its lower half, over some seeds.
struct Means {
  double image = 0, lower = 0, image_error = 0, lower_error = 0;
};
Means means_of(const SceneDescription& scene, const char* integrator, std::int64_t spp) {
  constexpr int seeds = 8;
  std::vector<double> image, lower;
  for (int seed = 1; seed <= seeds; ++seed) {
    RenderJob job = job_with(spp, 100'000, static_cast<std::uint64_t>(seed));
    job.budget.photons.reset();
    const Image mean = render(scene, integrator, job).image.mean;
    image.push_back(test::image_mean(mean));
    lower.push_back(test::block_mean(mean, 0, mean.height / 2, mean.width, mean.height / 2));
  }
  const auto summary = [](const std::vector<double>& of, double& mean, double& error) {
    double squares = 0;
    for (const double v : of) mean += v / seeds;
    for (const double v : of) squares += (v - mean) * (v - mean);
    error = std::sqrt(squares / (seeds - 1) / seeds);
  };
  Means means;
  summary(image, means.image, means.image_error);
  summary(lower, means.lower, means.lower_error);
  return means;
}

/// Checks agreement within 4 standard errors of the difference, which are below `most` of the mean. A caustic counted
/// twice or not at all is 2 % of the room's light, and 6 % of that of its lower half.
void expect_agreement(const SceneDescription& scene, double most) {
  const Means path = means_of(scene, "path", 512), other = means_of(traced_on(scene), "photonmapper", 128);
  const auto expect = [&](double a, double b, double a_error, double b_error, const char* what) {
    const double error = std::hypot(a_error, b_error);
    std::printf("%s: %+.3f %%, standard error %.3f %%\n", what, 100 * (b / a - 1), 100 * error / a);
    EXPECT_LT(error, most * a) << what;
    EXPECT_NEAR(b, a, 4 * error) << what;
  };
  expect(path.image, other.image, path.image_error, other.image_error, "image");
  expect(path.lower, other.lower, path.lower_error, other.lower_error, "lower half");
}

/// The room with the light out of view: its few bright pixels would carry most of the mean's noise.
SceneDescription room_without_light(bool with_balls) {
  SceneDescription scene = test::room(32, with_balls);
  scene.integrator.method = PathDescription{-1, 5, true};
  return scene;
}

TEST(path_beside_caustics, rooms_have_the_path_tracers_mean) {
  expect_agreement(room_without_light(false), 0.001);
  expect_agreement(room_without_light(true), 0.006);
}

TEST(path_beside_caustics, a_room_under_a_sky_has_the_path_tracers_mean) {
  // Bounces meet the sky, which light sampling also finds. The mirror shows it unweighted, and the glass refracts it
  // into caustics.
  SceneDescription scene = room_without_light(true);
  scene.shapes.erase(scene.shapes.begin() + 2);  // the ceiling
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD{0.5, 0.7, 1}}});
  expect_agreement(scene, 0.004);
}

TEST(path_beside_caustics, same_seed_gives_the_same_bits_at_1_2_and_7_threads) {
  for (const bool with_balls : {false, true})
    test::expect_same_bits_at_any_threads(traced_on(test::room(40, with_balls)), "photonmapper", job_with(8, 30'000));
}

TEST(path_beside_caustics, v3_and_v4_give_the_same_bits) {
  test::expect_instruction_sets_agree(traced_on(test::room(24, true)), "photonmapper", job_with(8, 30'000));
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
