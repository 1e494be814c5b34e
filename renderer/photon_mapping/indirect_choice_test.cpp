// The choice between maps and path tracing. It must be the faster one by the formulas of indirect_choice.h, solved here
// by other means. Scenes made for one of the methods must get it.

#include "renderer/photon_mapping/indirect_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/area_price.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// Pilot values: a path sample has four times the variance of a maps sample and takes twice as long. That is eight
/// times the time to equal noise. One photon is emitted every other sample.
IndirectPilot pilot_of_a_room() {
  IndirectPilot pilot;
  pilot.maps = {.variance = 0.1, .nanoseconds = 100};
  pilot.beside_caustics = {.variance = 0.4, .nanoseconds = 200};
  pilot.indirect_square = 0.2;
  pilot.photons_a_sample = 65536 / 2.0;
  pilot.pixels = 65536;
  return pilot;
}

RenderBudget target(double error) {
  RenderBudget budget;
  budget.target_error = error;
  return budget;
}

TEST(indirect_choice, falls_on_the_maps_early_and_on_paths_late) {
  // At e = 1e-2 few photons suffice and the maps' noise is 0.1 / S: paths take eight times as long. With many photons,
  // the rest of the maps' error is 1.5 x 0.2 / M. It falls to e^2 after M = 0.3 / e^2 photons in a disc. That takes 1e6
  // (M / 700)^(3/2) photons in all, or 30.5 (M / 700)^(3/2) samples. For e = 1e-3 the maps need 2.7e5 samples of 100
  // ns, and some for the noise; paths need 0.4 / 1e-6 = 4e5 of 200 ns. For e = 1e-4 the maps need 2.7e8 and paths 4e7.
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(1e-2), 4).indirect, IndirectLight::map);
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(1e-3), 4).indirect, IndirectLight::map);
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(1e-4), 4).indirect, IndirectLight::path);
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(1e-6), 4).indirect, IndirectLight::path);
}

TEST(indirect_choice, turns_where_the_times_are_equal) {
  // Both times, by the formulas: t_maps = 100 S with 0.1 / S + 0.3 / (700 (S / 30.517578)^(2/3)) = e^2, t_paths = 200 x
  // 0.4 / e^2. For e^2 = 1e-9 the first term is negligible, S = 30.5 (0.3 / (700 e^2))^(3/2) = 8.56e9 and t_maps =
  // 8.6e11 against 8e10. At 1e-7: 8.56e6 + some, 8.8e8 against 8e8. At 1.5e-7: 4.66e6 + .5e6, about 5.1e8 against
  // 5.3e8.
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(std::sqrt(1e-9)), 4).indirect, IndirectLight::path);
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(std::sqrt(0.7e-7)), 4).indirect, IndirectLight::path);
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(std::sqrt(1.5e-7)), 4).indirect, IndirectLight::map);
}

TEST(indirect_choice, heeds_samples_and_seconds) {
  RenderBudget budget;
  budget.spp = 64;
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), budget, 4).indirect, IndirectLight::map);
  budget.spp = std::int64_t{1} << 32;
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), budget, 4).indirect, IndirectLight::path);
  budget.spp.reset();
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), budget, 64).indirect, IndirectLight::map);
  budget.seconds = 1;  // 65536 pixels x 100 ns: 152 samples
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), budget, 4).indirect, IndirectLight::map);
  budget.seconds = 1e7;
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), budget, 4).indirect, IndirectLight::path);
}

TEST(indirect_choice, leaves_the_caustic_map_out_only_where_paths_alone_are_sooner) {
  IndirectPilot pilot = pilot_of_a_room();
  pilot.caustics = true;
  pilot.beside_caustics.variance = 0.04;
  EXPECT_TRUE(choose_indirect(pilot, target(0.01), 4).caustic_map);
  pilot.paths_alone = WayOfLight{.variance = 0.04, .nanoseconds = 150};
  EXPECT_FALSE(choose_indirect(pilot, target(0.01), 4).caustic_map);
  pilot.paths_alone = WayOfLight{.variance = 0.06, .nanoseconds = 150};
  EXPECT_TRUE(choose_indirect(pilot, target(0.01), 4).caustic_map);
}

RenderJob free_job() {
  RenderJob job = test::job_with(8);
  job.budget.photons.reset();
  return job;
}

TEST(indirect_choice, of_a_closed_room_is_the_maps_and_of_balls_on_a_floor_path_tracing) {
  const auto room = test::render(test::room(32, true), "photonmapper", free_job());
  EXPECT_THAT(room.stats.choices, testing::ElementsAre(testing::StartsWith("indirect light by photon maps")));
  EXPECT_GT(room.stats.counts.at("photons_emitted_global"), 0);
  // A furnace has no noise at all.
  const auto furnace = test::render(test::furnace(0.5, 1, 16), "photonmapper", free_job());
  EXPECT_THAT(furnace.stats.choices, testing::ElementsAre(testing::StartsWith("indirect light by path tracing alone")));
  EXPECT_EQ(furnace.stats.counts.count("photons_emitted_global"), 0);
}

TEST(indirect_choice, is_the_maps_where_photons_radii_or_parts_of_the_light_are_asked_for) {
  const SceneDescription furnace = test::furnace(0.5, 1, 16);
  EXPECT_TRUE(test::render(furnace, "photonmapper", test::job_with(8, 1000)).stats.choices.empty());
  const SceneDescription within = test::with_indirect(furnace, IndirectLight::automatic, 0.1);
  EXPECT_TRUE(test::render(within, "photonmapper", free_job()).stats.choices.empty());
  RenderJob part = free_job();
  part.view = Aov::global;
  EXPECT_TRUE(test::render(furnace, "photonmapper", part).stats.choices.empty());
}

// A gather on rough ground visits many triangles within its radius to learn their area. On a floor there is nothing to
// visit, so that path tracing takes several times as many times the maps' time.
TEST(indirect_choice, knows_what_gathers_on_meshes_cost) {
  const auto ground = [](bool rough) {
    SceneDescription d;
    const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{RgbD(0.8)});
    if (rough)
      test::add_shape(
          d, HeightfieldDescription{.columns = 200, .rows = 200, .amplitude = 0.1, .height = HeightfieldNoise{20, 20}},
          Transform::rotate({1, 0, 0}, -90), grey);
    else
      test::add_shape(d, RectangleDescription{}, Transform::rotate({1, 0, 0}, -90), grey);
    test::add_shape(d, RectangleDescription{}, Transform::translate({0, 0.5, -0.5}) * Transform::scale(Vec3d(0.5)),
                    grey);
    PointLightDescription lamp;
    lamp.position = {0, 1.5, 0.5};
    d.emitters.push_back({{}, "", lamp});
    test::set_camera(d, Transform::look_at({0, 1, 3}, {0, 0, 0}, {0, 1, 0}), 40, 32);
    const std::string why = test::render(d, "photonmapper", free_job()).stats.choices.at(0);
    const std::size_t number =
        why.find("path tracing alone ", why.find(" gives ")) + std::strlen("path tracing alone ");
    return std::stod(why.substr(number));
  };
  EXPECT_LT(ground(true), ground(false) / 4);
}

TEST(area_price, counts_the_triangles_of_a_disc_and_of_its_border) {
  SceneDescription d;
  const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{});
  const HeightfieldDescription flat{.columns = 100, .rows = 50, .amplitude = 0, .height = HeightfieldNoise{}};
  test::add_shape(d, flat, {}, grey);
  test::add_shape(d, RectangleDescription{}, {}, grey);
  d.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
  test::set_camera(d, Transform::look_at({0, 0, 3}, {0, 0, 0}, {0, 1, 0}), 40, 16);
  const Scene scene = test::compiled(d, 16, 16);
  // 2500 triangles a unit of area, in the scene's own unit.
  const auto scale = static_cast<float>(scene.scale());
  const AreaPrices near(scene, 0.1f * scale), all(scene, 10 * scale);
  const AreaPrices nearest(scene, 0.05f * scale);
  const double within = 2500 * 0.0025 * 3.14159265;
  EXPECT_NEAR(nearest.of(0), 6 * within + 100 * std::sqrt(4 * 3.14159265 * within), 1);
  EXPECT_NEAR(near.of(0), 4 * 6 * within + 2 * 100 * std::sqrt(4 * 3.14159265 * within), 1);
  EXPECT_NEAR(all.of(0), 6 * 200 + 100 * 50, 1) << "flat groups count whole";
  EXPECT_EQ(near.of(1), 0);
  // On rough ground, which has more area, fewer triangles are within. Of all 10,000 a sample counts.
  std::get<HeightfieldDescription>(d.shapes[0].geometry).amplitude = 0.1;
  std::get<HeightfieldDescription>(d.shapes[0].geometry).height = HeightfieldNoise{40, 40};
  const Scene rough = test::compiled(d, 16, 16);
  const auto rough_scale = static_cast<float>(rough.scale());
  EXPECT_EQ(AreaPrices(rough, 10 * rough_scale).of(0), 40e3);
  EXPECT_GT(AreaPrices(rough, 0.1f * rough_scale).of(0), 2 * AreaPrices(rough, 0.05f * rough_scale).of(0));
  EXPECT_LT(AreaPrices(rough, 0.05f * rough_scale).of(0), 6 * within + 180 * std::sqrt(4 * 3.14159265 * within));
  EXPECT_EQ(AreaPrices(rough, 10 * rough_scale).time_of({3, 5}), 3 * 40e3);
}

// A wall of 1 x 1 on an infinite plane of albedo 0.8 under a sky of radiance 1, seen from the front. The whole plane
// lights the wall from below. Maps miss light from outside the ball around the wall, of radius 1/sqrt 2.
TEST(indirect_choice, is_path_tracing_where_a_plane_without_end_lies_under_a_sky) {
  SceneDescription d;
  const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{RgbD(0.8)});
  test::add_shape(d, PlaneDescription{}, Transform::rotate({1, 0, 0}, -90), grey);
  test::add_shape(d, RectangleDescription{}, Transform::translate({0, 0.5, 0}) * Transform::scale(Vec3d(0.5)), grey);
  d.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
  test::set_camera(d, Transform::look_at({0, 0.5, 3}, {0, 0.5, 0}, {0, 1, 0}), 15, 16);
  const double path = test::image_mean(test::render(d, "path", test::job_with(1024)).image.mean);
  RenderJob job = test::job_with(256);
  job.budget.photons.reset();
  const auto chosen = test::render(d, "photonmapper", job);
  EXPECT_THAT(chosen.stats.choices, testing::ElementsAre(testing::StartsWith("indirect light by path tracing: ")));
  EXPECT_THAT(chosen.stats.losses, testing::IsEmpty());
  EXPECT_NEAR(test::image_mean(chosen.image.mean) / path, 1, 2e-3);
  const auto maps = test::render(test::with_indirect(d, IndirectLight::map), "photonmapper", job);
  EXPECT_THAT(maps.stats.losses, testing::ElementsAre(light_that_maps_miss));
  const double missed = 1 - test::image_mean(maps.image.mean) / path;
  std::printf("a wall on a plane without end: maps miss %.1f %%\n", 100 * missed);
  EXPECT_GT(missed, 0.05);
}

TEST(indirect_choice, is_the_same_at_1_2_and_7_threads) {
  test::expect_same_bits_at_any_threads(test::room(40, true), "photonmapper", free_job());
  test::expect_same_bits_at_any_threads(test::furnace(0.5, 1, 24), "photonmapper", free_job());
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
