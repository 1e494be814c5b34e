// The camera pilot finds lights that are rarely met, and causes no bias.

#include "renderer/photon_mapping/camera_pilot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "renderer/kernels/light_search.h"
#include "renderer/photon_mapping/photon_maps.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// The room with one glass ball under a light that appears in it a hundredth of a pixel wide.
SceneDescription room_with_tiny_light(int size) {
  SceneDescription scene = test::room(size, true);
  scene.shapes.pop_back();  // the mirror
  for (ShapeDescription& shape : scene.shapes) {
    if (!shape.radiance) continue;
    shape.to_world =
        Transform::translate({0, 0.99, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(0.02));
    shape.radiance = RgbD(1500);
  }
  return scene;
}

Image rendered(const SceneDescription& scene, const char* integrator, std::int64_t spp, std::uint64_t seed) {
  RenderJob job = test::job_with(spp, 0, seed);
  job.budget.photons.reset();
  return test::render(scene, integrator, job).image.mean;
}

/// Largest share of one pixel in the image's relmse.
double worst_pixel(const Image& image, const Image& reference) {
  double worst = 0;
  const double pixels = static_cast<double>(image.rgb.size()) / 3;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    double error = 0;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double a = double{image.rgb[c]}, b = double{reference.rgb[c]};
      error += (a - b) * (a - b) / (b * b + Film::relative_epsilon) / 3;
    }
    worst = std::max(worst, error / pixels);
  }
  return worst;
}

// With equally probable lobes the samples' mean square equals that of ordinary samples, p X^2 + (1 - p) Y^2.
TEST(camera_pilot, even_lobes_keep_the_mean_square) {
  constexpr int draws = 1000;
  for (const float p : {0.0f, 0.02f, 0.3f, 0.97f, 1.0f}) {
    double square = 0, reflections = 0;
    for (int i = 0; i < draws; ++i) {
      float u = (static_cast<float>(i) + 0.5f) / draws;
      const double root = static_cast<double>(even_lobes(p, u));
      const bool reflects = u < p;
      square += std::pow(root * (reflects ? 50 : 3), 2) / draws;
      reflections += reflects ? 1.0 / draws : 0.0;
    }
    const double q = static_cast<double>(p);
    EXPECT_NEAR(square, q * 2500 + (1 - q) * 9, 1e-4 * square) << p;
    EXPECT_NEAR(reflections, p <= 0 ? 0 : p >= 1 ? 1 : 0.5, 1e-9) << p;
  }
}

// A ball of radius 0.1 lies 0.3 beside a ray: the near contribution is a third of its radiance, and no light is met.
TEST(camera_pilot, a_ray_is_worth_the_part_of_a_light_that_its_distance_is_of_the_radius) {
  struct State {
    Vec3f origin{0, 0, 0}, direction{0, 0, 1}, throughput{0.5f, 0.25f, 0}, radiance{0, 0, 0};
  };
  const LightBall area_light{{0.3f, 0, 2}, 0.1f, 60};
  const auto found = [&](float within, float x, float end) {
    State s;
    s.origin.x = x;
    SurfaceHit<float> hit;
    hit.valid = true;
    hit.p = {x, 0, end};
    find_lights<State, float>({&area_light, 1, within}, s, hit, true);
    return s.radiance;
  };
  EXPECT_NEAR(found(4, 0, 9).z, 10, 1e-4);
  EXPECT_EQ(found(4, 0, 9).x, 0);
  EXPECT_EQ(found(2.9f, 0, 9).z, 0) << "farther than what is near";
  EXPECT_EQ(found(4, 0.25f, 9).x, 30) << "inside";
  EXPECT_EQ(found(4, 0.25f, 9).z, 30);
  EXPECT_EQ(found(4, 0.25f, 1).x, 0) << "hidden";
}

// The pilot against an independent reference: pixels in which the path tracer met the light behind the glass get many
// more samples.
TEST(camera_pilot, finds_the_pixels_where_a_path_tracer_meets_the_light) {
  constexpr int size = 128;
  const SceneDescription description = room_with_tiny_light(size);
  SceneDescription black = description;  // leaves only the light's images in mirrors and glass
  for (BsdfDescription& bsdf : black.bsdfs)
    if (auto* diffuse = std::get_if<DiffuseDescription>(&bsdf.model)) *diffuse = DiffuseDescription{RgbD(0)};
  const Image shown = rendered(black, "path", 2048, 5);
  const Scene scene = test::compiled(description, size, size, {});
  AdaptiveSampleMap effort(Tile{0, 0, size, size});
  RenderStats stats;
  const RenderJob job = test::job_with(1, 0, 1);
  const Threads threads(2);
  run_camera_pilot(scene, PathSettings{}, job, threads, Tile{0, 0, size, size}, effort, stats);
  effort.choose();
  double shown_light = 0, steered_light = 0;
  int chosen = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (effort.extra(x, y) > 0) ++chosen;
      if (y < 40) continue;  // the light itself
      const double light = static_cast<double>(shown.pixel(x, y)[0]);
      shown_light += light;
      if (effort.extra(x, y) >= 7) steered_light += light;
    }
  std::printf("%.3g of the light's light of %.3g is in steered pixels, %d chosen\n", steered_light, shown_light,
              chosen);
  EXPECT_GT(shown_light, 1);
  // The rest was met once in 2048 samples of a pixel.
  EXPECT_GT(steered_light, 0.85 * shown_light);
  EXPECT_LT(chosen, size * size / 20);
}

TEST(camera_pilot, no_seed_is_stuck_on_a_firefly) {
  const SceneDescription scene = room_with_tiny_light(64);
  const Image reference = rendered(scene, "photonmapper", 1024, 1000);
  std::vector<double> worst;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    worst.push_back(worst_pixel(rendered(scene, "photonmapper", 16, seed), reference));
  std::ranges::sort(worst);
  std::printf("worst pixel: median %.2g, most %.2g %.2g %.2g\n", worst[20], worst[37], worst[38], worst[39]);
  EXPECT_LT(worst[39], 20 * worst[20]);
}

// A seed of the photon mapper has a third of the path tracer's error and takes five times as long. With these numbers
// of seeds the difference has an error of 8 % of the mean, so that the test detects a loss of 40 %.
TEST(camera_pilot, an_image_has_the_path_tracers_mean) {
  const SceneDescription scene = room_with_tiny_light(24);
  double mean[2] = {}, variance[2] = {};
  for (int which = 0; which < 2; ++which) {
    const std::uint64_t seeds = which == 0 ? 8 : 56;
    std::vector<double> means;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)  // the ball's pixels
      means.push_back(test::block_mean(rendered(scene, which == 0 ? "photonmapper" : "path", 256, seed), 13, 14, 8, 8));
    const auto n = static_cast<double>(seeds);
    for (const double v : means) mean[which] += v / n;
    for (const double v : means) variance[which] += (v - mean[which]) * (v - mean[which]) / (n - 1) / n;
  }
  std::printf("photon mapper %.5f, path tracer %.5f +- %.5f\n", mean[0], mean[1], std::sqrt(variance[0] + variance[1]));
  EXPECT_NEAR(mean[0], mean[1], 4 * std::sqrt(variance[0] + variance[1]) + 0.01 * mean[1]);
}

TEST(camera_pilot, costs_nothing_without_mirrors_or_smooth_glass) {
  EXPECT_EQ(
      test::render(test::room(24, false), "photonmapper", test::job_with(2)).stats.counts.count("pilot_camera_samples"),
      0u);
  EXPECT_GT(
      test::render(test::room(24, true), "photonmapper", test::job_with(2)).stats.counts.at("pilot_camera_samples"), 0);
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
