// The photon mapper's views: parts of its light add up to the image, and views of numbers report the render's
// statistics.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "renderer/passes/aov.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::Rendered;

Rendered seen(const SceneDescription& scene, Aov view, RenderJob job, const char* integrator = "photonmapper") {
  job.view = view;
  return test::render(scene, integrator, job);
}

/// A job in which the photon mapper chooses its own budgets.
RenderJob free_job(std::int64_t spp, std::uint64_t seed = 1) {
  RenderJob job = test::job_with(spp, 0, seed);
  job.budget.photons.reset();
  return job;
}

double count_of(const Rendered& out, const std::string& name) {
  const auto found = out.stats.counts.find(name);
  return found != out.stats.counts.end() ? found->second : 0;
}

/// The room with slightly rough glass and mirror, so that no pilot searches for lights in them. First passes of the
/// whole image then take one sample a pixel, as those of its parts do. Without roulette: it would apply where paths
/// continue, but not where they end at photons.
SceneDescription rough_room() {
  SceneDescription scene = test::room(32, true);
  scene.integrator.method = PathDescription{12, 1000, false};
  for (BsdfDescription& bsdf : scene.bsdfs) {
    if (std::holds_alternative<DielectricDescription>(bsdf.model)) bsdf.model = RoughDielectricDescription{};
    if (std::holds_alternative<ConductorDescription>(bsdf.model)) bsdf.model = RoughConductorDescription{};
  }
  return scene;
}

/// Every value of the image is the sum of the parts' values, each of which was rounded.
void expect_sum(const Rendered& image, const std::vector<const Rendered*>& parts) {
  for (std::size_t i = 0; i < image.image.mean.rgb.size(); ++i) {
    double sum = 0;
    for (const Rendered* part : parts) sum += double{part->image.mean.rgb[i]};
    ASSERT_NEAR(double{image.image.mean.rgb[i]}, sum, 1e-6 * (sum + 1e-3)) << i;
  }
}

void expect_parts_add_up(const SceneDescription& scene, const char* integrator, const RenderJob& job) {
  const auto view = [&](Aov v) { return seen(scene, v, job, integrator); };
  const Rendered whole = view(Aov::whole), direct = view(Aov::direct), caustics = view(Aov::caustics),
                 global = view(Aov::global), indirect = view(Aov::indirect);
  for (const Rendered* part : {&direct, &caustics, &global})
    EXPECT_GT(test::image_mean(part->image.mean), 0.005) << "nothing is tested";
  expect_sum(whole, {&direct, &caustics, &global});
  expect_sum(indirect, {&caustics, &global});
  EXPECT_EQ(count_of(caustics, "radius_caustic"), count_of(whole, "radius_caustic"));
  EXPECT_EQ(count_of(global, "radius_global"), count_of(whole, "radius_global"));
}

TEST(views, parts_of_the_light_add_up_to_the_image) {
  // A pixel has one sample in each of two passes: samples share no gathers, and no pass depends on an earlier image.
  SceneDescription scene = test::with_indirect(rough_room(), IndirectLight::map);
  expect_parts_add_up(scene, "photonmapper", free_job(2));
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(0.5)}});  // the room is open towards the camera
  expect_parts_add_up(scene, "photonmapper", free_job(2));
}

TEST(views, parts_of_every_kind_of_indirect_light_add_up) {
  SceneDescription scene = rough_room();
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(0.5)}});
  for (const IndirectLight indirect : {IndirectLight::gather, IndirectLight::cache, IndirectLight::path}) {
    SCOPED_TRACE(word_of(indirect));
    expect_parts_add_up(test::with_indirect(scene, indirect), "photonmapper", free_job(2));
  }
}

TEST(views, parts_of_the_light_on_rough_surfaces_add_up) {
  SceneDescription scene = rough_room();
  scene.shapes[1].bsdf = test::add_bsdf(scene, PhongDescription{100.0, RgbD{0.2, 0.5, 0.3}, RgbD(0.4)});
  scene.shapes[3].bsdf = test::add_bsdf(scene, PlasticDescription{});
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(0.5)}});  // every part also traces rays to it
  for (const IndirectLight indirect : {IndirectLight::map, IndirectLight::gather, IndirectLight::path}) {
    SCOPED_TRACE(word_of(indirect));
    expect_parts_add_up(test::with_indirect(scene, indirect), "photonmapper", free_job(2));
  }
}

TEST(views, parts_of_textbook_settings_add_up_at_any_number_of_samples) {
  expect_parts_add_up(test::room(32, true), "sppm", free_job(9));
}

// All adaptive features are on, and seeds differ. Means of the image and of the floor, where the caustics are, agree
// within 4 standard errors of their difference, which are small.
TEST(views, parts_of_an_adaptive_render_add_up_in_the_mean) {
  const SceneDescription scene = test::with_indirect(test::room(24, true), IndirectLight::map);
  constexpr int seeds = 16;
  const auto of_seed = [&](Aov view, int seed) {
    const Image image = seen(scene, view, free_job(64, static_cast<std::uint64_t>(seed))).image.mean;
    return std::pair{test::image_mean(image), test::block_mean(image, 4, 18, 16, 5)};
  };
  std::vector<double> image, floor;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto whole = of_seed(Aov::whole, seed);
    double sum = -whole.first, floor_sum = -whole.second;
    for (const Aov part : {Aov::direct, Aov::caustics, Aov::global}) {
      const auto of_part = of_seed(part, 1000 * static_cast<int>(part) + seed);
      sum += of_part.first;
      floor_sum += of_part.second;
    }
    image.push_back(sum / whole.first);
    floor.push_back(floor_sum / whole.second);
  }
  for (const auto& differences : {image, floor}) {
    double mean = 0, variance = 0;
    for (const double d : differences) mean += d / seeds;
    for (const double d : differences) variance += (d - mean) * (d - mean) / (seeds - 1) / seeds;
    std::printf("parts against the image: %+.4f, standard error %.4f\n", mean, std::sqrt(variance));
    EXPECT_LT(std::sqrt(variance), 0.005);
    EXPECT_NEAR(mean, 0, 4 * std::sqrt(variance));
  }
}

TEST(views, what_is_not_shown_is_not_done) {
  const SceneDescription scene = test::room(16, true);
  const Rendered direct = seen(scene, Aov::direct, free_job(4));
  EXPECT_THAT(direct.stats.skipped, testing::IsSupersetOf({"global-map: the view does not show it",
                                                           "caustic-map: the view does not show it"}));
  EXPECT_EQ(count_of(direct, "rays_photon"), 0);
  EXPECT_GT(count_of(direct, "rays_shadow"), 0);
  const Rendered caustics = seen(scene, Aov::caustics, free_job(4));
  EXPECT_THAT(caustics.stats.skipped, testing::IsSupersetOf({"global-map: the view does not show it",
                                                             "direct-light: the view does not show it"}));
  EXPECT_EQ(count_of(caustics, "photons_emitted_global"), 0);
  EXPECT_GT(count_of(caustics, "photons_emitted_caustic"), 0);
  EXPECT_EQ(count_of(caustics, "rays_shadow"), 0);
  const Rendered global = seen(scene, Aov::global, free_job(4));
  EXPECT_EQ(count_of(global, "photons_emitted_caustic"), 0);
  EXPECT_EQ(count_of(global, "rays_shadow"), 0);
  EXPECT_EQ(count_of(seen(scene, Aov::photons, free_job(4)), "rays_camera"), 0);
}

TEST(views, what_is_done_all_the_same_is_not_shown) {
  const SceneDescription scene = test::room(16, true);
  for (const Aov view : {Aov::direct, Aov::caustics, Aov::global, Aov::indirect}) {
    RenderJob job = free_job(8);
    const Rendered without = seen(scene, view, job);
    job.skips = SkipSwitches({"global-map", "caustic-map", "direct-light"});
    const Rendered with = seen(scene, view, job);
    EXPECT_GT(count_of(with, "photons_emitted_global") * count_of(with, "photons_emitted_caustic"), 0);
    EXPECT_GT(count_of(with, "rays_shadow"), 0);
    EXPECT_EQ(with.image.mean.rgb, without.image.mean.rgb) << aov_row(view).name;
  }
}

TEST(views, samples_are_one_each_until_passes_disagree_and_all_that_the_camera_sent) {
  const SceneDescription scene = test::room(32, true);
  for (const float value : seen(rough_room(), Aov::samples, free_job(2)).image.mean.rgb) ASSERT_EQ(value, 1.0f);
  constexpr int spp = 48;
  const Rendered later = seen(scene, Aov::samples, free_job(spp));
  const Image& samples = later.image.mean;
  const auto [least, most] = std::ranges::minmax(samples.rgb);
  EXPECT_GE(least, 1.0f);
  EXPECT_GT(most, 4.0f);
  EXPECT_LE(most, 64.0f);
  const double sent = count_of(later, "rays_camera") - count_of(later, "pilot_camera_samples");
  EXPECT_NEAR(test::image_mean(samples) * 32 * 32 * spp, sent, 1e-5 * 32 * 32 * spp);
  // The glass ball shows the light in spots; the wall above it is lit evenly.
  EXPECT_GT(test::block_mean(samples, 18, 20, 8, 8), 1.5 * test::block_mean(samples, 12, 8, 8, 8));
  // These are the samples and radii of the whole image; views of parts of the light trace the same camera paths.
  const Rendered whole = seen(scene, Aov::whole, free_job(spp));
  for (const Aov view : {Aov::samples, Aov::radius, Aov::time})
    for (const char* count : {"rays_camera", "rays_shadow", "radius_global", "radius_caustic"})
      EXPECT_EQ(count_of(seen(scene, view, free_job(spp)), count), count_of(whole, count)) << count;
  for (const Aov view : {Aov::direct, Aov::caustics, Aov::global, Aov::indirect})
    EXPECT_EQ(count_of(seen(scene, view, free_job(spp)), "rays_camera"), 32 * 32 * spp);
}

TEST(views, time_is_that_of_the_render) {
  RenderJob job = free_job(16);
  job.threads = 1;
  const Rendered out = seen(test::room(48, true), Aov::time, job);
  const double seconds = 1e-6 * test::image_mean(out.image.mean) * 48 * 48 * 16;
  EXPECT_LE(seconds, out.stats.phases.at("render"));
  EXPECT_GT(seconds, 0.2 * out.stats.phases.at("render"));
}

constexpr int plate_pixels = 32;

/// A floor of 8 x 8 at y = 0, fully visible from the camera at (0, 30, 0), with a point light at (0, 2, 0). A mirror
/// lies in the plane x = 4, from y = 0.25 to 1 and z = -1 to 1. The light's image is at (8, 2, 0). Its light that
/// passes the mirror at the height y meets the floor at x = 8 - 4 * 2/(2 - y): from 0 to 3.43. So each photon that
/// meets the mirror is stored on the floor, and no other is.
SceneDescription mirror_beside_floor() {
  SceneDescription scene;
  const BsdfIndex grey = test::add_bsdf(scene, DiffuseDescription{});
  test::add_shape(scene, RectangleDescription{}, Transform::rotate({1, 0, 0}, -90) * Transform::scale(Vec3d(4)), grey);
  const Transform upright = Transform::translate({4, 0.625, 0}) * Transform::rotate({0, 1, 0}, -90);
  test::add_shape(scene, RectangleDescription{}, upright * Transform::scale({1, 0.375, 1}),
                  test::add_bsdf(scene, ConductorDescription{}));
  scene.emitters.push_back({{}, "", PointLightDescription{{0, 2, 0}, RgbD(1)}});
  test::set_camera(scene, Transform::look_at({0, 30, 0}, {0, 0, 0}, {0, 0, 1}), 20, plate_pixels);
  PhotonMapperDescription settings;
  settings.max_depth = -1;
  settings.caustic_radius = 0.5;
  scene.integrator.method = settings;
  return scene;
}

/// Solid angle of the mirror from the light, 4 in front of it, as a share of the sphere. The rectangle's corners are at
/// z = -1 and 1 and at y = -1.75 and -1. The solid angle from its foot to a corner (a, b) is atan(a b / (d sqrt(a^2 +
/// b^2 + d^2))).
double share_of_mirror() {
  const auto corner = [](double a, double b) { return std::atan(a * b / (4 * std::sqrt(a * a + b * b + 16))); };
  return 2 * (corner(1, 1.75) - corner(1, 1)) / (4 * std::numbers::pi);
}

RenderJob job_of_all_directions() {
  RenderJob job = test::job_with(4, 400'000);
  job.sampler = SamplerKind::independent;
  job.skips = SkipSwitches({"stray-photons"});
  return job;
}

double dots(const Rendered& out) { return test::image_mean(out.image.mean) * plate_pixels * plate_pixels * 4; }

TEST(views, each_photon_on_a_floor_that_is_seen_whole_is_a_dot_where_it_landed) {
  const SceneDescription scene = mirror_beside_floor();
  const Rendered photons = seen(scene, Aov::photons, job_of_all_directions());
  const double expected = 400'000 * share_of_mirror();
  EXPECT_NEAR(dots(photons), expected, 4 * std::sqrt(expected));
  EXPECT_NEAR(dots(photons), count_of(photons, "photons_stored_caustic"), 1e-5 * expected);
  // A dot's pixel has a camera sample in the same pass, at most a pixel's diagonal away: 0.47 of the radius 0.5.
  const Image caustics = seen(scene, Aov::caustics, job_of_all_directions()).image.mean;
  int lit = 0;
  for (std::size_t i = 0; i < caustics.rgb.size(); ++i) {
    if (photons.image.mean.rgb[i] == 0) continue;
    EXPECT_GT(caustics.rgb[i], 0) << i;
    ++lit;
  }
  EXPECT_GT(lit, 100);
}

TEST(views, photons_behind_something_or_on_the_other_side_are_not_seen) {
  SceneDescription below = mirror_beside_floor();
  test::set_camera(below, Transform::look_at({0, -30, 0}, {0, 0, 0}, {0, 0, 1}), 20, plate_pixels);
  const Rendered from_below = seen(below, Aov::photons, job_of_all_directions());
  EXPECT_GT(count_of(from_below, "photons_stored_caustic"), 100);
  EXPECT_EQ(dots(from_below), 0);
  // A mirror 10 below the camera, over the half of positive z, whose back reflects no light down.
  SceneDescription half = mirror_beside_floor();
  test::add_shape(half, RectangleDescription{},
                  Transform::translate({0, 20, 4}) * Transform::rotate({1, 0, 0}, -90) * Transform::scale(Vec3d(4)),
                  {1});
  const Rendered halved = seen(half, Aov::photons, job_of_all_directions());
  const double expected = 400'000 * share_of_mirror() / 2;
  EXPECT_NEAR(dots(halved), expected, 4 * std::sqrt(expected));
}

TEST(views, radius_is_that_of_the_stats_over_the_size_of_a_pixel) {
  // The camera looks straight down on the floor: a pixel is 2 tan(10 degrees) 30 / 32 wide there.
  const double pixel = 2 * std::tan(std::numbers::pi / 18) * 30 / plate_pixels;
  const Rendered out = seen(mirror_beside_floor(), Aov::radius, job_of_all_directions());
  const double expected = count_of(out, "radius_caustic") / pixel;
  EXPECT_NEAR(expected, 0.5 / pixel, 1e-6);
  for (int y = 8; y < 24; ++y)
    for (int x = 8; x < 24; ++x) {
      EXPECT_NEAR(double{out.image.mean.pixel(x, y)[0]}, expected, 1e-5 * expected);
      EXPECT_EQ(out.image.mean.pixel(x, y)[1], 0.0f) << "there is no global map";
      EXPECT_EQ(out.image.mean.pixel(x, y)[2], 0.0f);
    }
  EXPECT_EQ(out.image.mean.pixel(0, 0)[0], 0.0f) << "nothing is seen";
}

TEST(views, radius_of_several_passes_is_their_mean) {
  // The first pass has the given radius, the second the radius at the end of a one-pass render's stats. The camera
  // looks at the back wall along its normal from 4.9; the light is 0.25 wide in front of the wall.
  SceneDescription scene = test::room(32, true);
  SppmDescription settings;
  settings.radius = 0.2;
  scene.integrator.method = settings;
  const double second = count_of(seen(scene, Aov::whole, free_job(1), "sppm"), "radius_global");
  EXPECT_LT(second, 0.2);
  const Image radius = seen(scene, Aov::radius, free_job(2), "sppm").image.mean;
  const double expected = (0.2 + second) / 2 / (2 * std::tan(std::numbers::pi / 10) * 4.9 / 32);
  for (int y = 10; y < 16; ++y)
    for (int x = 12; x < 20; ++x)
      for (int map = 0; map < 2; ++map)
        EXPECT_NEAR(double{radius.pixel(x, y)[map]}, expected, 1e-5 * expected) << x << " " << y;
}

TEST(views, records_of_a_cache_are_refused_where_there_is_none) {
  try {
    seen(test::floor_under_point_light(8), Aov::cache_records, free_job(1));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.summary(),
              "--view: error: there are no cache-records to show, since there is no global photon map: no two diffuse "
              "surfaces see each other");
  }
}

TEST(views, have_the_same_bits_at_1_2_and_7_threads) {
  const SceneDescription scene = test::room(40, true);
  for (const Aov view : {Aov::caustics, Aov::photons, Aov::radius, Aov::samples, Aov::cache_records}) {
    RenderJob job = free_job(8);
    job.threads = 1;
    const Rendered one = seen(scene, view, job);
    for (const int threads : {2, 7}) {
      job.threads = threads;
      const Rendered many = seen(scene, view, job);
      EXPECT_EQ(one.image.mean.rgb, many.image.mean.rgb) << aov_row(view).name;
      EXPECT_EQ(one.image.variance->rgb, many.image.variance->rgb) << aov_row(view).name;
    }
  }
}

TEST(views, are_found_by_their_names) {
  for (const AovRow& row : aov_table()) {
    EXPECT_EQ(aov_named(row.name), row.view);
    EXPECT_STREQ(aov_row(row.view).name, row.name);
  }
  try {
    aov_named("caustic");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.summary(),
              "--view: error: there is no view 'caustic', expected one of whole, direct, caustics, global, indirect, "
              "photons, radius, samples, cache-records, time");
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
