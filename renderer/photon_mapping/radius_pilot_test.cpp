// Radii that the pilot finds, against the best of many fixed radii. The reference has a thousand times the photons
// within a disc that is too small to blur.

#include "renderer/photon_mapping/radius_pilot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr std::int64_t photons = 20'000;

double relmse(const Image& image, const Image& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const double r{reference.rgb[i]}, off = double{image.rgb[i]} - r;
    sum += off * off / (r * r + 0.01);
  }
  return sum / static_cast<double>(image.rgb.size());
}

/// One pass that shows the light of one map; a radius of 0 is left to the pilot.
Image light_of_map(const SceneDescription& scene, Aov view, double radius, std::int64_t spp, std::int64_t count,
                   std::uint64_t seed) {
  RenderJob job = test::job_with(spp, count, seed);
  job.view = view;
  return test::render(test::with_indirect(scene, IndirectLight::map, radius), "photonmapper", job).image.mean;
}

double mean_relmse(const SceneDescription& scene, Aov view, double radius, const Image& reference) {
  constexpr std::uint64_t seeds = 8;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    sum += relmse(light_of_map(scene, view, radius, 1, photons, seed), reference);
  return sum / seeds;
}

/// The error with the pilot's radius, as a factor of the error with the best fixed radius.
double excess(const SceneDescription& scene, Aov view, double fine_radius) {
  const Image reference = light_of_map(scene, view, fine_radius, 64, 1000 * photons, 99);
  double least = std::numeric_limits<double>::infinity();
  for (double radius = 0.01; radius < 1.5; radius *= 1.26)
    least = std::min(least, mean_relmse(scene, view, radius, reference));
  return mean_relmse(scene, view, 0, reference) / least;
}

// The guess of before, the disc of a fixed number of photons, has 2 to 15 times the least error on the first two.
TEST(radius_pilot, nearly_has_the_least_error_of_fixed_radii) {
  const double even = excess(test::room(48, false), Aov::global, 0.05);
  EXPECT_LT(even, 1.5) << "even light in a room";
  SceneDescription behind = test::room(48, false);  // a wall with a slit hides the light
  const BsdfIndex grey = test::add_bsdf(behind, DiffuseDescription{RgbD(0.5)});
  test::add_shape(behind, RectangleDescription{}, Transform::translate({0, 0.55, 0.6}) * Transform::scale({1, 0.4, 1}),
                  grey);
  const double dim = excess(behind, Aov::global, 0.05), caustic = excess(test::room(48, true), Aov::caustics, 0.01);
  EXPECT_LT(dim, 1.5) << "few photons in sight";
  EXPECT_LT(caustic, 1.5) << "a sharp caustic";
  std::printf("errors: %.2f, %.2f and %.2f times the least\n", even, dim, caustic);
}

/// A room with a lamp on either side of a dark slot between two walls, a tenth of the image wide.
SceneDescription room_with_slot(int size) {
  SceneDescription d = test::room(size, false);
  const Transform ceiling = d.shapes.back().to_world;
  d.shapes.back().radiance = RgbD(200);
  d.shapes.back().to_world = Transform::translate({-0.5, 0, 0}) * ceiling;
  d.shapes.push_back(d.shapes.back());
  d.shapes.back().to_world = Transform::translate({0.5, 0, 0}) * ceiling;
  for (const double x : {-0.12, 0.12})
    test::add_shape(d, RectangleDescription{}, Transform::translate({x, 0, 0}) * Transform::rotate({0, 1, 0}, 90), {0});
  return d;
}

/// The error of the global map that the pilot expects of so many photons in all, by pixels around or by groups alone.
double expected_error(const SceneDescription& d, bool around) {
  const RenderJob job = test::job_with(1, photons);
  const int size = d.sensor.film.width;
  const Scene scene = test::compiled(d, size, size);
  const SceneDescription by_map = test::with_indirect(d, IndirectLight::map);
  const RenderPlan plan = plan_render(analyse(scene), with_integrator(by_map.integrator, "photonmapper"), job);
  const PhotonSettings settings(plan.method, job);
  const Threads threads(1);
  const PhotonSource source{scene, settings, job, threads};
  PhotonMaps maps(plan, source);
  RenderStats stats;
  maps.choose_first_radii(source, stats);
  const GatherAreas areas(scene, threads);
  const PathSettings paths = camera_path_settings(settings, plan);
  RadiusPilot pilot(source, paths, areas, Tile{0, 0, size, size});
  const auto emitted = static_cast<double>(pilot_photons);
  return pilot
      .try_radii(maps.global.pilot, emitted,
                 {.least = guessed_radius(maps.global, emitted),
                  .most = widest_useful(scene),
                  .most_found = std::numeric_limits<double>::infinity(),
                  .least_exponent = smooth_exponent,
                  .smooth = around})
      .error(static_cast<double>(photons));
}

// Light leaks under the walls into the slot, where errors count as much as a hundred times their square. The reference
// is the image by path tracing. Relative to groups of pixels, some of which are bright, hardly any error is expected.
// The brightest pixels around hide most of it, too: a choice by this error leans to the maps.
TEST(radius_pilot, expects_more_error_of_light_that_leaks_into_the_dark_by_pixels_around) {
  const SceneDescription d = room_with_slot(128);
  const Image whole = test::render(d, "path", test::job_with(256)).image.mean;
  const Image reference = light_of_map(d, Aov::global, 0.02, 16, 250 * photons, 99);
  double actual = 0;
  constexpr std::uint64_t seeds = 4;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Image map = light_of_map(d, Aov::global, 0, 1, photons, seed);
    for (std::size_t i = 0; i < map.rgb.size(); ++i) {
      const double off = double{map.rgb[i]} - double{reference.rgb[i]}, r{whole.rgb[i]};
      actual += off * off / (r * r + 0.01) / static_cast<double>(map.rgb.size() * seeds);
    }
  }
  const double expected = expected_error(d, true), by_groups = expected_error(d, false);
  std::printf("an error of %.4f is expected, by groups %.4f, and is %.4f\n", expected, by_groups, actual);
  EXPECT_GT(expected, 1.5 * by_groups);
  EXPECT_LT(expected, actual);
}

// A mirror ball is in the dark below the floor. It might throw light on the floor, but no photon reaches it.
TEST(radius_pilot, leaves_few_photons_to_a_map_that_the_pilot_finds_empty) {
  SceneDescription d = test::floor_under_point_light(16);
  test::add_shape(d, SphereDescription{{0, -2, 0}, 0.5}, {}, test::add_bsdf(d, ConductorDescription{}));
  RenderJob job = test::job_with(1);
  job.budget.photons.reset();
  const auto out = test::render(test::with_indirect(d, IndirectLight::map), "photonmapper", job);
  EXPECT_EQ(out.stats.counts.at("photons_emitted_global"), 16384 / 16);
  EXPECT_EQ(out.stats.counts.at("photons_emitted_caustic"), 16384 / 16);
  EXPECT_THAT(out.stats.choices, testing::ElementsAre(testing::StartsWith("one photon in 16 for the global map: "),
                                                      testing::StartsWith("one photon in 16 for the caustic map: ")));
  const auto asked = test::render(test::with_indirect(d, IndirectLight::map), "photonmapper", test::job_with(1, 5000));
  EXPECT_EQ(asked.stats.counts.at("photons_emitted_global"), 5000);
  EXPECT_TRUE(asked.stats.choices.empty());
}

TEST(radius_pilot, has_no_trials_without_photons) {
  // The camera looks at a floor that no light reaches twice.
  const auto out = test::render(test::with_indirect(test::floor_under_point_light(16), IndirectLight::map),
                                "photonmapper", test::job_with(1, 1000));
  EXPECT_FALSE(out.stats.counts.contains("radius_global"));
}

TEST(radius_pilot, finds_the_same_radius_with_any_number_of_threads) {
  RenderJob job = test::job_with(2, photons);
  const auto out = test::expect_same_bits_at_any_threads(test::with_indirect(test::room(24, true), IndirectLight::map),
                                                         "photonmapper", job);
  EXPECT_GT(out.stats.counts.at("radius_global"), 0);
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
