// Radii that the pilot finds, against the best of many fixed radii. The reference has a thousand times the photons
// within a disc that is too small to blur.

#include "renderer/photon_mapping/radius_pilot.h"

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
