// Small scenes built in code for the tests, so that they need no file and no parser.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "renderer/integrators/integrator.h"
#include "renderer/kernels/camera_rays.h"
#include "renderer/kernels/isa.h"
#include "renderer/planning/test_compiled.h"

namespace photonproof::test {

inline BsdfIndex add_bsdf(SceneDescription& scene, const decltype(BsdfDescription::model)& model) {
  scene.bsdfs.push_back({{}, "", model});
  return {static_cast<std::uint32_t>(scene.bsdfs.size() - 1)};
}

inline ShapeDescription& add_shape(SceneDescription& scene, const decltype(ShapeDescription::geometry)& geometry,
                                   const Transform& to_world, BsdfIndex bsdf) {
  ShapeDescription shape;
  shape.geometry = geometry;
  shape.to_world = to_world;
  shape.bsdf = bsdf;
  scene.shapes.push_back(shape);
  return scene.shapes.back();
}

inline void set_camera(SceneDescription& scene, const Transform& to_world, double fov_degrees, int size) {
  PerspectiveDescription camera;
  camera.fov_degrees = fov_degrees;
  scene.sensor.camera = camera;
  scene.sensor.to_world = to_world;
  scene.sensor.film.width = scene.sensor.film.height = size;
}

/// A closed sphere of albedo rho that emits e from every point: the radiance is e / (1 - rho) everywhere.
inline SceneDescription furnace(double albedo, double emission, int size) {
  SceneDescription scene;
  const BsdfIndex wall = add_bsdf(scene, DiffuseDescription{RgbD(albedo)});
  ShapeDescription& sphere = add_shape(scene, SphereDescription{}, {}, wall);
  sphere.flip_normals = true;
  sphere.radiance = RgbD(emission);
  set_camera(scene, Transform::look_at({0.2, 0.1, -0.3}, {0.4, -0.2, 1}, {0, 1, 0}), 90, size);
  scene.integrator.method = PathDescription{-1, 24, false};
  return scene;
}

/// A floor of albedo 0.5 at y = 0 under a point light of intensity 1 at (0, 2, 0), seen from above.
inline SceneDescription floor_under_point_light(int size) {
  SceneDescription scene;
  const BsdfIndex grey = add_bsdf(scene, DiffuseDescription{});
  add_shape(scene, RectangleDescription{}, Transform::rotate({1, 0, 0}, -90) * Transform::scale(Vec3d(4)), grey);
  scene.emitters.push_back({{}, "", PointLightDescription{{0, 2, 0}, RgbD(1)}});
  set_camera(scene, Transform::look_at({0, 5, 0}, {0, 0, 0}, {0, 0, 1}), 40, size);
  return scene;
}

/// A room [-1,1]^3 with coloured walls, a square light under its ceiling, a glass and a mirror ball.
inline SceneDescription room(int size, bool with_balls) {
  SceneDescription scene;
  const BsdfIndex white = add_bsdf(scene, DiffuseDescription{RgbD(0.7)});
  const BsdfIndex red = add_bsdf(scene, DiffuseDescription{RgbD{0.6, 0.1, 0.1}});
  const Transform inward = Transform::translate({0, 0, -1});  // then rotated to each side
  add_shape(scene, RectangleDescription{}, inward, white);
  add_shape(scene, RectangleDescription{}, Transform::rotate({1, 0, 0}, -90) * inward, white);
  add_shape(scene, RectangleDescription{}, Transform::rotate({1, 0, 0}, 90) * inward, white);
  add_shape(scene, RectangleDescription{}, Transform::rotate({0, 1, 0}, 90) * inward, red);
  add_shape(scene, RectangleDescription{}, Transform::rotate({0, 1, 0}, -90) * inward, white);
  ShapeDescription& light =
      add_shape(scene, RectangleDescription{},
                Transform::translate({0, 0.99, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(0.25)),
                add_bsdf(scene, DiffuseDescription{RgbD(0)}));
  light.radiance = RgbD(10);
  if (with_balls) {
    DielectricDescription glass;
    glass.int_ior = 1.5;
    glass.ext_ior = 1.0;
    add_shape(scene, SphereDescription{{0.4, -0.6, 0.2}, 0.35}, {}, add_bsdf(scene, glass));
    add_shape(scene, SphereDescription{{-0.4, -0.6, -0.3}, 0.35}, {}, add_bsdf(scene, ConductorDescription{}));
  }
  set_camera(scene, Transform::look_at({0, 0, 3.9}, {0, 0, 0}, {0, 1, 0}), 36, size);
  return scene;
}

/// The ray of the camera kernel through the middle of a pixel.
inline CameraRay<float> ray_through_pixel(const SceneView& scene, int x, int y) {
  CameraTask task{};
  task.x0 = x;
  task.y0 = y;
  task.x1 = x + 1;
  task.y1 = y + 1;
  task.samples = 1;
  task.grid = 1;
  return camera_rays<float>(scene, task, 0);
}

struct Rendered {
  Rendering image;
  RenderStats stats;
};

/// Renders a compiled scene as it is, by any method.
inline void render(const Scene& scene, const IntegratorDescription& method, const RenderJob& job, Film& film,
                   RenderStats& stats) {
  photonproof::render(scene, plan_render(analyse(scene), method, job), job, film, stats);
}

inline Rendered render(const SceneDescription& description, const char* integrator, const RenderJob& job,
                       std::size_t small_limit = brute_force_limit) {
  const FilmDescription size = description.sensor.film;
  const Scene scene = test::compiled(description, size.width, size.height, job.skips, small_limit);
  Film film(size.width, size.height);
  Rendered out;
  render(scene, with_integrator(description.integrator, integrator), job, film, out.stats);
  out.image = film.develop();
  return out;
}

/// Renders with 1, 2 and 7 threads and returns the first.
inline Rendered expect_same_bits_at_any_threads(const SceneDescription& scene, const char* integrator, RenderJob job) {
  job.threads = 1;
  Rendered one = render(scene, integrator, job);
  for (const int threads : {2, 7}) {
    job.threads = threads;
    const Rendered many = render(scene, integrator, job);
    EXPECT_EQ(one.image.mean.rgb, many.image.mean.rgb) << threads;
    EXPECT_EQ(one.image.variance->rgb, many.image.variance->rgb) << threads;
    for (const auto& [name, count] : one.stats.counts) EXPECT_EQ(many.stats.counts.at(name), count) << name;
    EXPECT_EQ(one.stats.choices, many.stats.choices);
  }
  return one;
}

/// The scene with its limits and the photon mapper with this indirect light. A positive `radius` applies to both maps.
inline SceneDescription with_indirect(SceneDescription scene, IndirectLight indirect, double radius = 0) {
  PhotonMapperDescription settings;
  static_cast<PathLimits&>(settings) = scene.integrator.limits();
  settings.indirect = indirect;
  settings.global_radius = settings.caustic_radius = radius;
  scene.integrator.method = settings;
  return scene;
}

inline RenderJob job_with(std::int64_t spp, std::int64_t photons = 100'000, std::uint64_t seed = 1) {
  RenderJob job;
  job.budget.spp = spp;
  job.budget.photons = photons;
  job.seed = seed;
  return job;
}

/// Mean over a block of pixels and all channels.
inline double block_mean(const Image& image, int x0, int y0, int width, int height) {
  double sum = 0;
  for (int y = y0; y < y0 + height; ++y)
    for (int x = x0; x < x0 + width; ++x)
      for (int c = 0; c < 3; ++c) sum += double{image.pixel(x, y)[c]};
  return sum / (3.0 * width * height);
}
inline double image_mean(const Image& image) { return block_mean(image, 0, 0, image.width, image.height); }

/// Checks that the means of all instruction sets agree. v3 and v4, which differ only in width, must agree to the bit.
inline void expect_instruction_sets_agree(const SceneDescription& scene, const char* integrator, RenderJob job) {
  std::map<std::string, Image> images;
  for (const Kernels& kernels : available_kernels()) {
    job.isa = kernels.isa;
    images[kernels.isa] = render(scene, integrator, job).image.mean;
  }
  const double scalar = image_mean(images.at("scalar"));
  for (const auto& [isa, image] : images) EXPECT_NEAR(image_mean(image), scalar, 1e-3 * scalar) << isa;
  if (images.contains("v3") && images.contains("v4")) {
    EXPECT_EQ(images.at("v3").rgb, images.at("v4").rgb);
  }
}

}  // namespace photonproof::test
