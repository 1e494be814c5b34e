// The weights of light in the photon mapper's adaptive sampling, one at a time. Each test uses only pixels that got
// samples beyond those of every pixel. It compares them with values that share no code with the renderer, or with the
// path tracer, which does not adapt. A weight that is 3 % wrong there fails.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_passes {
namespace {

using test::add_bsdf;
using test::add_shape;

struct Adapted {
  Image image;
  Image samples;  ///< of each pixel over those of every pixel, mean over passes
};

Adapted adapted(const SceneDescription& scene, RenderJob job) {
  Adapted out;
  out.image = test::render(scene, "photonmapper", job).image.mean;
  job.view = Aov::samples;
  out.samples = test::render(scene, "photonmapper", job).image.mean;
  return out;
}

/// Mean over the pixels with at least a given multiple of the samples, and their number.
struct Part {
  double mean = 0, expected = 0;
  int pixels = 0;

  double ratio() const { return mean / expected; }
};

Part of_pixels(const Image& image, const Image& chosen_by, double least,
               const std::function<double(int x, int y)>& expected) {
  Part part;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (!(double{chosen_by.pixel(x, y)[0]} >= least)) continue;
      for (int c = 0; c < 3; ++c) part.mean += double{image.pixel(x, y)[c]} / 3;
      part.expected += expected(x, y);
      ++part.pixels;
    }
  part.mean /= std::max(1, part.pixels);
  part.expected /= std::max(1, part.pixels);
  return part;
}

/// Length of the part of [i, i + 1] in [low, high].
double covered(int i, double low, double high) {
  return std::max(0.0, std::min(i + 1.0, high) - std::max(double(i), low));
}

/// A light of radiance 1, from -half to half in x and y, before nothing; parallel rays of size x size pixels see [-1,
/// 1].
SceneDescription light_alone(double half, int size) {
  SceneDescription scene;
  ShapeDescription& light = add_shape(scene, RectangleDescription{}, Transform::scale(Vec3d(half)),
                                      add_bsdf(scene, DiffuseDescription{RgbD(0)}));
  light.radiance = RgbD(1);
  scene.sensor.camera = OrthographicDescription{};
  scene.sensor.to_world = Transform::look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
  scene.sensor.film.width = scene.sensor.film.height = size;
  return scene;
}

// A pixel's mean is the part of it that the light covers, which is a product of lengths. Passes disagree at its rim
// alone. With 64 samples and more per pixel the mean over the rim has an error of .1 %.
TEST(adaptive_weights, pixels_with_more_samples_show_the_part_of_them_that_a_light_covers) {
  constexpr int size = 16;
  constexpr double half = 0.53;
  const double low = (1 - half) * size / 2, high = (1 + half) * size / 2;
  const Adapted out = adapted(light_alone(half, size), test::job_with(64, 1000));
  const Part rim = of_pixels(out.image, out.samples, 1.5,
                             [&](int x, int y) { return covered(x, low, high) * covered(y, low, high); });
  std::printf("rim of a light: %d pixels, %.5f of what they cover\n", rim.pixels, rim.ratio());
  EXPECT_GE(rim.pixels, 30);
  EXPECT_NEAR(rim.ratio(), 1, 0.005);
  // Pixels beside the rim, which lie in the light, see it with every sample.
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      if (covered(x, low, high) * covered(y, low, high) >= 1) {
        EXPECT_NEAR(out.image.pixel(x, y)[0], 1, 1e-5) << x << ' ' << y;
      }
}

// A pass must be weighted by its own length: passes after one that met the light take more samples, and would count
// more by their number. Where a light covers 4 % of a pixel, the mean over renders is 4 %, measured to 2 % here.
// Weighting passes by their samples would give 3.5 % (measured with that fault).
TEST(adaptive_weights, passes_that_follow_a_lucky_one_count_no_more) {
  constexpr int size = 8, renders = 4000;
  constexpr double half = 0.5 + 0.04 * 2 / size;
  const SceneDescription scene = light_alone(half, size);
  double sum = 0, squares = 0;
  for (int render = 1; render <= renders; ++render) {
    RenderJob job = test::job_with(8, 1000, static_cast<std::uint64_t>(render));
    job.sampler = SamplerKind::independent;
    const Image image = test::render(scene, "photonmapper", job).image.mean;
    const double mean = test::block_mean(image, 1, 3, 1, 2);
    sum += mean / renders;
    squares += mean * mean / renders;
  }
  const double error = std::sqrt((squares - sum * sum) / renders);
  std::printf("pixels covered to .04: %.5f +- %.5f\n", sum, error);
  EXPECT_LT(error, 0.02 * 0.04);
  EXPECT_NEAR(sum, 0.04, 4 * error);
}

/// A box whose walls all have the radiance 2, in and out: e / (1 - rho). The visible wall is black and emits 2 without
/// noise. Its right edge reflects .9 as the other walls do, so that most of its light is indirect.
SceneDescription box_with_a_quiet_wall(int size) {
  SceneDescription scene;
  const BsdfIndex grey = add_bsdf(scene, DiffuseDescription{RgbD(0.9)}),
                  black = add_bsdf(scene, DiffuseDescription{RgbD(0)});
  const Transform inward = Transform::translate({0, 0, -1});
  const auto wall = [&](const Transform& place, BsdfIndex bsdf, double emitted) {
    add_shape(scene, RectangleDescription{}, place, bsdf).radiance = RgbD(emitted);
  };
  for (const double angle : {90.0, -90.0, 180.0}) wall(Transform::rotate({0, 1, 0}, angle) * inward, grey, 0.2);
  for (const double angle : {90.0, -90.0}) wall(Transform::rotate({1, 0, 0}, angle) * inward, grey, 0.2);
  wall(Transform::translate({-0.2, 0, -1}) * Transform::scale({0.8, 1, 1}), black, 2);
  wall(Transform::translate({0.8, 0, -1}) * Transform::scale({0.2, 1, 1}), grey, 0.2);
  test::set_camera(scene, Transform::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}), 80, size);
  scene.integrator.method = PathDescription{-1, 24, false};
  return scene;
}

// Light of the lights, of photons, of a final gather, of paths and of a cache alike: all walls are as bright.
TEST(adaptive_weights, pixels_with_more_samples_are_as_bright_as_a_furnace_by_every_way_of_indirect_light) {
  for (const auto& way : indirect_words) {
    if (way.value == IndirectLight::automatic) continue;
    const Adapted out = adapted(test::with_indirect(box_with_a_quiet_wall(32), way.value), test::job_with(64, 500'000));
    const Part more = of_pixels(out.image, out.samples, 2, [](int, int) { return 2.0; });
    std::printf("indirect light by %s: %d pixels, %.4f of the furnace\n", way.text, more.pixels, more.ratio());
    EXPECT_GE(more.pixels, 50) << way.text;
    EXPECT_NEAR(more.ratio(), 1, 0.01) << way.text;
  }
}

/// A light that shines on a mirror alone, which lights a rough metal behind the light; the metal is an eighth of the
/// image, and the rest is black.
SceneDescription rough_metal_by_a_mirror(int size) {
  SceneDescription scene;
  RoughConductorDescription metal;
  metal.alpha_u = metal.alpha_v = 0.4;
  const Transform face_up = Transform::rotate({1, 0, 0}, -90), face_left = Transform::rotate({0, 1, 0}, -90);
  add_shape(scene, RectangleDescription{},
            Transform::translate({-1, 0, 0}) * face_up * Transform::scale({0.35, 0.7, 1}), add_bsdf(scene, metal));
  add_shape(scene, RectangleDescription{}, Transform::translate({1.5, 1, 0}) * face_left * Transform::scale(Vec3d(1.5)),
            add_bsdf(scene, ConductorDescription{}));
  add_shape(scene, RectangleDescription{},
            Transform::translate({0, 1, 0}) * Transform::rotate({0, 1, 0}, 90) * Transform::scale(Vec3d(0.4)),
            add_bsdf(scene, DiffuseDescription{RgbD(0)}))
      .radiance = RgbD(10);
  test::set_camera(scene, Transform::look_at({-3.2, 1.6, 0}, {-1, 0, 0}, {0, 1, 0}), 50, size);
  scene.integrator.method = PathDescription{-1, 24, false};
  return scene;
}

// All of its light comes from photons, gathered by their directions. The path tracer finds it by reflections that go to
// the light by the mirror.
TEST(adaptive_weights, rough_pixels_with_more_samples_are_as_bright_as_by_paths) {
  constexpr int size = 16;
  const SceneDescription scene = rough_metal_by_a_mirror(size);
  const Adapted out = adapted(test::with_indirect(scene, IndirectLight::map), test::job_with(64, 4'000'000));
  const Image paths = test::render(scene, "path", test::job_with(16384)).image.mean;
  const Part more = of_pixels(out.image, out.samples, 1.5, [&](int x, int y) {
    return (double{paths.pixel(x, y)[0]} + double{paths.pixel(x, y)[1]} + double{paths.pixel(x, y)[2]}) / 3;
  });
  std::printf("rough metal: %d pixels, %.4f of paths\n", more.pixels, more.ratio());
  EXPECT_GE(more.pixels, 20);
  EXPECT_NEAR(more.ratio(), 1, 0.012);
}

}  // namespace
}  // namespace photonproof::inline renderer_passes
