// The choice between maps and path tracing. It must be the faster one by the formulas of indirect_choice.h, solved here
// by other means. Scenes made for one of the methods must get it.

#include "renderer/photon_mapping/indirect_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "renderer/integrators/test_scenes.h"
#include "renderer/photon_mapping/path_pilot.h"
#include "renderer/planning/area_price.h"
#include "scenes/parser/parser.h"

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
  // 0.4 / e^2. Paths are taken up to 0.95 times the maps' time. For e^2 = 1e-9 the first term is negligible, S = 30.5
  // (0.3 / (700 e^2))^(3/2) = 8.56e9 and t_maps = 8.6e11 against 8e10. At 1.3e-7: S = 6.9e6, where the terms
  // are 1.45e-8 and 1.155e-7, so 6.9e8 against 6.15e8. At 1.8e-7: S = 4.36e6, where they are 2.3e-8 and 1.57e-7, so
  // 4.36e8 against 4.44e8. The factors are 0.89 and 1.02.
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(std::sqrt(1e-9)), 4).indirect, IndirectLight::path);
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(std::sqrt(1.3e-7)), 4).indirect, IndirectLight::path);
  EXPECT_EQ(choose_indirect(pilot_of_a_room(), target(std::sqrt(1.8e-7)), 4).indirect, IndirectLight::map);
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
  pilot.beside_caustics.variance = 0.02;
  EXPECT_TRUE(choose_indirect(pilot, target(0.01), 4).caustic_map);
  EXPECT_EQ(choose_indirect(pilot, target(0.01), 4).indirect, IndirectLight::path);
  pilot.paths_alone = WayOfLight{.variance = 0.02, .nanoseconds = 150};
  EXPECT_FALSE(choose_indirect(pilot, target(0.01), 4).caustic_map);
  pilot.paths_alone = WayOfLight{.variance = 0.03, .nanoseconds = 150};
  EXPECT_TRUE(choose_indirect(pilot, target(0.01), 4).caustic_map);
}

// A path sample of half the variance in the same time: nearly half of the maps' time.
TEST(indirect_choice, needs_far_better_paths_beside_the_caustic_map) {
  IndirectPilot pilot = pilot_of_a_room();
  const auto chosen = [&](double part) {
    pilot.beside_caustics = {.variance = part * pilot.maps.variance, .nanoseconds = pilot.maps.nanoseconds};
    pilot.paths_alone.reset();
    if (pilot.caustics) pilot.paths_alone = WayOfLight{.variance = 1, .nanoseconds = 1000};
    return choose_indirect(pilot, target(0.3), 4).indirect;
  };
  EXPECT_EQ(chosen(1.0), IndirectLight::map);
  EXPECT_EQ(chosen(0.9), IndirectLight::path);
  pilot.caustics = true;
  EXPECT_EQ(chosen(0.68), IndirectLight::map);
  EXPECT_EQ(chosen(0.5), IndirectLight::path);
}

RenderJob free_job() {
  RenderJob job = test::job_with(8);
  job.budget.photons.reset();
  return job;
}

TEST(indirect_choice, of_a_closed_room_is_the_maps_and_of_balls_on_a_floor_path_tracing) {
  const auto room = test::render(test::room(128, true), "photonmapper", free_job());
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

struct Piloted {
  IndirectPilot pilot;
  double gathers_on_rough, time_on_rough;  ///< a camera sample
  double wide_area, narrow_area;           ///< prices of areas on the first surface, by the caustic map's radius
};

/// The photon mapper before its first photon.
struct Mapper {
  explicit Mapper(const SceneDescription& d)
      : size(d.sensor.film.width),
        scene(test::compiled(d, size, size)),
        plan(plan_render(analyse(scene), with_integrator(d.integrator, "photonmapper"), job)) {}

  const RenderJob job = free_job();
  const int size;
  const Scene scene;
  const RenderPlan plan;
  const PhotonSettings settings{plan.method, job};
  const Threads threads{1};
  const PhotonSource source{scene, settings, job, threads};
  PhotonMaps maps{plan, source};
  RenderStats stats;
};

/// Values of the pilots before radii are tried.
Piloted piloted(const SceneDescription& d) {
  Mapper mapper(d);
  IndirectPilots pilots(mapper.source, mapper.maps, mapper.plan, Tile{0, 0, mapper.size, mapper.size}, mapper.stats);
  mapper.maps.choose_first_radii(mapper.source, mapper.stats);
  pilots.trace_beside_photons();
  const float radius = mapper.maps.caustic.radii.radius;
  return {pilots.measured(), pilots.gathers_on_rough(), pilots.time_on_rough(), AreaPrices(mapper.scene, radius).of(0),
          AreaPrices(mapper.scene, radius / 2).of(0)};
}

/// Ground, of hills or flat.
SceneDescription ground(bool hills, const decltype(BsdfDescription::model)& model) {
  SceneDescription d;
  const BsdfIndex bsdf = test::add_bsdf(d, model);
  if (hills)
    test::add_shape(
        d, HeightfieldDescription{.columns = 200, .rows = 200, .amplitude = 0.1, .height = HeightfieldNoise{20, 20}},
        Transform::rotate({1, 0, 0}, -90), bsdf);
  else
    test::add_shape(d, RectangleDescription{}, Transform::rotate({1, 0, 0}, -90), bsdf);
  return d;
}

// A gather on hills visits many triangles within its radius to learn their area. On a floor there is nothing to visit.
TEST(indirect_choice, knows_what_gathers_on_meshes_cost) {
  const auto maps_time = [](bool hills) {
    SceneDescription d = ground(hills, DiffuseDescription{RgbD(0.8)});
    test::add_shape(d, RectangleDescription{}, Transform::translate({0, 0.5, -0.5}) * Transform::scale(Vec3d(0.5)),
                    {0});
    PointLightDescription lamp;
    lamp.position = {0, 1.5, 0.5};
    d.emitters.push_back({{}, "", lamp});
    test::set_camera(d, Transform::look_at({0, 1, 3}, {0, 0, 0}, {0, 1, 0}), 40, 32);
    return piloted(d).pilot.maps.nanoseconds;
  };
  EXPECT_GT(maps_time(true), 4 * maps_time(false));
}

/// Rough metal below a glass ball; the camera sees nothing else.
SceneDescription rough_ground(bool hills) {
  RoughConductorDescription metal;
  metal.alpha_u = metal.alpha_v = 0.4;
  SceneDescription d = ground(hills, metal);
  DielectricDescription glass;
  glass.int_ior = 1.5;
  glass.ext_ior = 1.0;
  test::add_shape(d, SphereDescription{{0, 0.8, 0}, 0.2}, {}, test::add_bsdf(d, glass));
  ShapeDescription& lamp =
      test::add_shape(d, RectangleDescription{},
                      Transform::translate({0, 2, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(0.2)),
                      test::add_bsdf(d, DiffuseDescription{RgbD(0)}));
  lamp.radiance = RgbD(10);
  test::set_camera(d, Transform::look_at({0, 0.5, 0.9}, {0, 0, 0.3}, {0, 1, 0}), 20, 32);
  return d;
}

// Every sample gathers on rough ground once, with a wide and a narrow radius. On hills each has an area to learn. Both
// methods with a caustic map pay for it.
TEST(indirect_choice, knows_what_gathers_on_rough_surfaces_cost) {
  const Piloted hills = piloted(rough_ground(true)), flat = piloted(rough_ground(false));
  for (const Piloted& values : {flat, hills}) {
    EXPECT_GT(values.gathers_on_rough, 0.999);
    EXPECT_LT(values.gathers_on_rough, 2) << "some paths come back from the ball or from hills";
  }
  const double areas = hills.gathers_on_rough * (hills.wide_area + hills.narrow_area);
  ASSERT_GT(areas, 100);
  const double without_areas = flat.time_on_rough * hills.gathers_on_rough / flat.gathers_on_rough;
  EXPECT_NEAR((hills.time_on_rough - without_areas) / areas, 1, 0.1);
  EXPECT_GT(hills.pilot.maps.nanoseconds, hills.time_on_rough);
  EXPECT_GT(hills.pilot.beside_caustics.nanoseconds, hills.time_on_rough);
}

/// A grey floor below a glass ball and a lamp of this radiance and half an edge, which no path finds by chance. The
/// ball's caustic has the same flux whatever the edge, if the radiance is in inverse proportion to its square.
SceneDescription floor_below_glass(double radiance, double half_edge) {
  SceneDescription d = rough_ground(false);
  d.bsdfs[0].model = DiffuseDescription{RgbD(0.5)};
  d.shapes.back().to_world =
      Transform::translate({0, 2, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(half_edge));
  d.shapes.back().radiance = RgbD(radiance);
  test::set_camera(d, Transform::look_at({0, 0.9, 1.6}, {0, 0, 0}, {0, 1, 0}), 30, 32);
  return d;
}

// The lamp's hits by paths are too rare for a pilot, which sees the same images for both lamps. The squares of hits are
// in proportion to the radiance. At most half of their sum comes from noise of the photons, and a tenth from the floor.
TEST(indirect_choice, bounds_the_variance_of_caustics_that_paths_rarely_find) {
  const IndirectPilot large = piloted(floor_below_glass(1e4, 0.01)).pilot;
  const IndirectPilot small = piloted(floor_below_glass(4e4, 0.005)).pilot;
  ASSERT_TRUE(large.paths_alone && small.paths_alone);
  EXPECT_GT(large.paths_alone->variance, 100 * large.beside_caustics.variance);
  EXPECT_NEAR(small.paths_alone->variance / large.paths_alone->variance, 4, 0.4);
}

// A path that goes on from a grey floor brings back half of the light it finds, whatever way it came.
TEST(path_pilot, tells_what_part_of_a_caustic_a_path_can_bring_back) {
  Mapper mapper(floor_below_glass(1e4, 0.01));
  MapState& caustic = mapper.maps.caustic;
  mapper.maps.choose_first_radii(mapper.source, mapper.stats);
  PhotonMap map;
  map.build(std::move(caustic.pilot), caustic.radii.radius, mapper.threads);
  const PathSettings paths = camera_path_settings(mapper.settings, mapper.plan);
  const PathPilot::CausticMap caustics{map, caustic.radii.radius};
  const PilotImage image =
      PathPilot(mapper.source, paths, Tile{0, 0, 32, 32}, 1024).trace(PathPolicy::beside_caustic_map, &caustics);
  const CausticLight light = caustic_light(image, image, Where::all_pixels);
  ASSERT_GT(light.all, 0.01);
  EXPECT_NEAR(light.dimmed / light.all, 0.5, 0.02);
}

/// Choice for a scene of the library at 64x64.
std::string choice_of(const std::string& scene, std::int64_t samples, std::uint64_t seed) {
  SceneDescription d = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + scene + "/scene.xml");
  d.sensor.film.width = d.sensor.film.height = 64;
  RenderJob job = test::job_with(samples);
  job.budget.photons.reset();
  job.seed = seed;
  const auto out = test::render(d, "photonmapper", job);
  return out.stats.choices.empty() ? "" : out.stats.choices.front();
}

// Paths alone would have a hundred times the maps' error here, and so would paths beside the caustic map. A pilot of
// few paths meets no hit of a lamp by glass, or a single one that is seen by the camera itself.
TEST(indirect_choice, is_the_maps_where_few_paths_meet_no_caustic) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    EXPECT_THAT(choice_of("cornell-spheres", 4, seed), testing::StartsWith("indirect light by photon maps"));
    EXPECT_THAT(choice_of("caustic-glass", 64, seed), testing::StartsWith("indirect light by photon maps"));
  }
}

// Paths have a fiftieth of the maps' error in a bright closed room, at a few samples, too.
TEST(indirect_choice, is_path_tracing_in_furnaces_at_few_samples) {
  for (const std::uint64_t seed : {1, 2, 3, 4})
    for (const std::int64_t samples : {1, 16})
      for (const char* scene : {"furnace-blendbsdf", "furnace-twosided"})
        EXPECT_THAT(choice_of(scene, samples, seed), testing::StartsWith("indirect light by path tracing alone"));
}

constexpr int set = PilotImage::samples_a_set;

/// Blocks of 8 pixels whose samples are all of this value.
PilotImage even_image(std::size_t pixels, double value) {
  PilotImage image;
  image.block = 8;
  image.pixels.assign(pixels, {{RgbD(set * value), RgbD(set * value)}, RgbD(2 * set * value * value)});
  return image;
}

void replace_sample(PilotImage& image, std::size_t pixel, double from, double to) {
  image.pixels[pixel].sum[0] += RgbD(to - from);
  image.pixels[pixel].squares += RgbD(to * to - from * from);
}

// One of 8 samples of a pixel is 101, the others are 1. The variance within the set is 100^2 / 4, and the mean of both
// sets is half of that. The difference of the sets' means is 25, so that 4 x 25^2 / 2 is the variance by sets: the
// same. The other pixels have mean 1, and 1 of 16 pixels has the variance: relmse 1250 / 1.01 / 16. The block's own
// mean, 1 + 100 / 64, hides 85 % of it.
TEST(path_pilot, does_not_hide_a_rare_sample_behind_itself_where_a_method_adds_it) {
  const PilotImage part = even_image(16, 1);
  PilotImage whole = part;
  replace_sample(whole, 3, 1, 101);
  const double own_mean = 1 + 100.0 / 64, hidden = 1250 / (own_mean * own_mean + 0.01) / 16;
  EXPECT_NEAR(variance_of(whole, whole, Samples::by_themselves), hidden, 0.1);
  EXPECT_NEAR(variance_of(whole, whole, Samples::spread), hidden, 0.1);
  const VarianceBeside added = variance_beside(part, whole);
  EXPECT_NEAR(added.added.variance, 1250 / 1.01 / 16, 1);
  EXPECT_NEAR(added.added.carriers, 1, 1e-9);
  EXPECT_EQ(added.common, 0);
  const VarianceBeside common = variance_beside(whole, whole);
  EXPECT_NEAR(common.common, hidden, 0.1);
  EXPECT_EQ(common.added.variance, 0);
}

// A hit that the part alone has, as where the whole's path took another turn, says nothing about it.
TEST(path_pilot, counts_a_rare_sample_of_the_part_only_where_the_whole_has_it) {
  const PilotImage whole = even_image(16, 1);
  PilotImage part = whole;
  replace_sample(part, 3, 1, 101);
  EXPECT_EQ(variance_within(part, whole).variance, 0);
  const Spread both = variance_within(part, part);
  EXPECT_GT(both.variance, 10);
  EXPECT_NEAR(both.carriers, 1, 1e-9);
}

// Both sets have the samples 0, 0, 2, 2: a variance of 4/3 each, whose mean over the set has no error at all.
TEST(path_pilot, knows_the_gain_of_samples_that_are_spread) {
  PilotImage image = even_image(8, 1);
  for (PilotImage::Pixel& pixel : image.pixels) pixel.squares = RgbD(16);
  EXPECT_NEAR(variance_of(image, image, Samples::by_themselves), 4.0 / 3 / 1.01, 1e-12);
  EXPECT_EQ(variance_of(image, image, Samples::spread), 0);
}

// The part lacks half of the light: relative to mean 1 its square is 0.25 / 1.01.
TEST(path_pilot, measures_the_light_that_a_part_lacks) {
  EXPECT_NEAR(mean_square_between(even_image(16, 0.5), even_image(16, 1)), 0.25 / 1.01, 1e-12);
}

// 16 pixels find as much light as one would, or all find some. Relative to mean 1 it is 0.5 / 1.01.
TEST(path_pilot, sees_how_many_pixels_find_light) {
  PilotImage part = even_image(16, 0.5), whole = even_image(16, 1);
  for (PilotImage* image : {&part, &whole})
    for (PilotImage::Pixel& pixel : image->pixels) pixel.without_photons = pixel.all();
  EXPECT_NEAR(light_between(part, whole, Where::all_pixels).relative, 0.5 / 1.01, 1e-9);
  EXPECT_NEAR(light_between(part, whole, Where::all_pixels).carriers, 16, 1e-9);
  for (std::size_t i = 4; i < 16; ++i) part.pixels[i].without_photons = whole.pixels[i].without_photons;
  EXPECT_NEAR(light_between(part, whole, Where::all_pixels).carriers, 4, 1e-9);
  part.pixels[0].rough = true;
  EXPECT_NEAR(light_between(part, whole, Where::without_rough).relative, 0.5 / 1.01 * 3 / 16, 1e-9);
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
