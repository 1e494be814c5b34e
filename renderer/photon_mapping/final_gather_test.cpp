// The photon mapper with final gathering against closed forms and the path tracer. photon_agreement_test.cpp also
// shows, block by block, that every path is counted exactly once.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

using test::job_with;
using test::render;

SceneDescription gathered(const SceneDescription& scene, double radius = 0) {
  return test::with_indirect(scene, IndirectLight::gather, radius);
}

/// The room with the light out of view: its few bright pixels would carry most of the mean's noise.
SceneDescription room_to_gather(bool with_balls) {
  SceneDescription scene = test::room(32, with_balls);
  scene.integrator.method = PathDescription{-1, 5, true};
  return scene;
}

TEST(final_gather, furnace_mean_and_blocks_are_two) {
  const auto out = render(gathered(test::furnace(0.5, 1, 32)), "photonmapper", job_with(64, 1'000'000));
  EXPECT_NEAR(test::image_mean(out.image.mean), 2.0, 0.003 * 2);
  for (int y = 0; y < 32; y += 8)
    for (int x = 0; x < 32; x += 8)
      EXPECT_NEAR(test::block_mean(out.image.mean, x, y, 8, 8), 2.0, 0.01 * 2) << x << ", " << y;
}

TEST(final_gather, depth_counts_the_bounce_and_light_edges_together) {
  // Emission and k - 1 bounces of albedo 1/2: 1, 1.5, 1.75, 1.875. To depth 2 there is no map. At depth 3 the second
  // hit has direct light alone, from depth 4 also photons.
  const double expected[] = {1, 1.5, 1.75, 1.875};
  for (int depth = 1; depth <= 4; ++depth) {
    SceneDescription scene = test::furnace(0.5, 1, 16);
    scene.integrator.method = PathDescription{depth, 24, false};
    const auto out = render(gathered(scene), "photonmapper", job_with(64, 500'000));
    EXPECT_NEAR(test::image_mean(out.image.mean), expected[depth - 1], 0.004 * expected[depth - 1]) << depth;
  }
}

TEST(final_gather, near_hits_that_are_traced_on_have_the_same_depth) {
  // In a sphere a gather within 2 R reaches everything: every second hit is a near one, and the third hit gathers
  // photons.
  SceneDescription scene = test::furnace(0.5, 1, 16);
  scene.integrator.method = PathDescription{4, 24, false};
  const auto out = render(gathered(scene, 2.01), "photonmapper", job_with(64, 500'000));
  EXPECT_NEAR(test::image_mean(out.image.mean), 1.875, 0.004 * 1.875);
}

TEST(final_gather, rooms_have_the_path_tracers_mean) {
  for (const bool with_balls : {false, true}) {
    const SceneDescription scene = room_to_gather(with_balls);
    const double path = test::image_mean(render(scene, "path", job_with(with_balls ? 1024 : 256)).image.mean);
    const double photons =
        test::image_mean(render(gathered(scene), "photonmapper", job_with(128, 1'000'000)).image.mean);
    EXPECT_NEAR(photons, path, (with_balls ? 0.015 : 0.005) * path) << with_balls;
  }
}

TEST(final_gather, open_scenes_under_a_sky_have_the_path_tracers_mean) {
  // The bounce meets the sky, which light sampling also finds: both are weighted. The mirror shows the sky unweighted.
  SceneDescription scene = room_to_gather(true);
  scene.shapes.erase(scene.shapes.begin() + 2);  // the ceiling
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD{0.5, 0.7, 1}}});
  const double path = test::image_mean(render(scene, "path", job_with(512)).image.mean);
  const double photons = test::image_mean(render(gathered(scene), "photonmapper", job_with(128, 1'000'000)).image.mean);
  EXPECT_NEAR(photons, path, 0.01 * path);
}

TEST(final_gather, same_seed_gives_the_same_bits_at_1_2_and_7_threads) {
  test::expect_same_bits_at_any_threads(gathered(test::room(40, true)), "photonmapper", job_with(8, 30'000));
}

TEST(final_gather, instruction_sets_agree) {
  const SceneDescription scene = gathered(test::room(24, true));
  test::expect_instruction_sets_agree(gathered(test::room(24, true)), "photonmapper", job_with(8, 30'000));
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
