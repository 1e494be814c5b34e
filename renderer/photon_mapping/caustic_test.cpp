// The isolated caustic of cornell-spheres: the photon mapper's flux on the floor against converged path tracing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/test_compiled.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// The scene cornell-spheres with all walls black except the floor. Light on the floor beyond direct light is then the
/// caustic alone.
SceneDescription floor_and_balls() {
  SceneDescription scene = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/cornell-spheres/scene.xml");
  scene.sensor.film.width = scene.sensor.film.height = 64;
  // The camera is closer to the caustic than the file's: paths that end elsewhere would only take time.
  scene.sensor.to_world = Transform::look_at({0, 0, 3.9}, {0.45, -0.98, 0.6}, {0, 1, 0});
  std::get<PerspectiveDescription>(scene.sensor.camera).fov_degrees = 14;
  const BsdfIndex black = test::add_bsdf(scene, DiffuseDescription{RgbD(0)});
  for (ShapeDescription& shape : scene.shapes) {
    const bool wall = std::holds_alternative<RectangleDescription>(shape.geometry);
    if (wall && shape.to_world.point({0, 0, 0}).y > -0.99) shape.bsdf = black;
  }
  return scene;
}

float height(const Surface& surface) {
  const auto* quad = std::get_if<Quad>(&surface.geometry);
  return quad == nullptr ? INFINITY : quad->corner.y + (quad->edge_u.y + quad->edge_v.y) / 2;
}

/// Pixels that see only the floor, as do their neighbours.
std::vector<std::size_t> floor_pixels(const Scene& scene) {
  const auto lowest = [](const Surface& a, const Surface& b) { return height(a) < height(b); };
  const auto floor = static_cast<std::uint32_t>(std::min_element(scene.surfaces.begin(), scene.surfaces.end(), lowest) -
                                                scene.surfaces.begin());
  const auto on_floor = [&](int x, int y) {
    const CameraRay<float> ray = test::ray_through_pixel(scene.view(), x, y);
    const Hit hit = scene.intersect(ray.origin, ray.direction);
    return hit.valid() && hit.surface == floor;
  };
  std::vector<std::size_t> pixels;
  for (int y = 1; y < scene.height - 1; ++y)
    for (int x = 1; x < scene.width - 1; ++x)
      if (on_floor(x - 1, y - 1) && on_floor(x + 1, y - 1) && on_floor(x - 1, y + 1) && on_floor(x + 1, y + 1))
        pixels.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) +
                         static_cast<std::size_t>(x));
  return pixels;
}

double floor_sum(const SceneDescription& description, const std::vector<std::size_t>& pixels, const char* integrator,
                 int max_depth, std::int64_t spp) {
  SceneDescription cut = description;
  cut.integrator.method = PathDescription{max_depth, 8, false};
  const Image image = test::render(cut, integrator, test::job_with(spp, 2'000'000)).image.mean;
  double sum = 0;
  for (const std::size_t i : pixels) sum += double{image.rgb[3 * i]} + image.rgb[3 * i + 1] + image.rgb[3 * i + 2];
  return sum;
}

// A beam of irradiance 3 along x meets a mirror at 45 degrees and goes straight down. The floor below has the
// irradiance 3, all of it caustic. With albedo 1/2 its radiance is 1.5 / pi, far from edges at any radius. Of 2e6
// photons 2e5 land in view: an error of 0.25 % if they were independent, and less with Sobol's points. Paths of three
// edges omit light that the floor sends to itself by the mirror. The test detects a loss of 1 % of the photons' energy.
TEST(caustic, of_a_plane_mirror_is_as_bright_as_the_beam) {
  SceneDescription scene;
  const BsdfIndex grey = test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)});
  const BsdfIndex mirror = test::add_bsdf(scene, ConductorDescription{});
  const Transform face_up = Transform::rotate({1, 0, 0}, -90);
  test::add_shape(scene, RectangleDescription{}, face_up * Transform::scale(Vec3d(1.2)), grey);
  test::add_shape(scene, RectangleDescription{},
                  Transform::translate({0, 1, 0}) * Transform::rotate({0, 0, 1}, 135) * face_up, mirror);
  DirectionalLightDescription beam;
  beam.direction = {1, 0, 0};
  beam.irradiance = RgbD(3);
  scene.emitters.push_back({{}, "", beam});
  test::set_camera(scene, Transform::look_at({0, 2.5, 4}, {0, 0, 0}, {0, 1, 0}), 5, 16);
  scene.integrator.method = PathDescription{3, 8, false};
  const auto out = test::render(scene, "photonmapper", test::job_with(16, 2'000'000));
  const double radiance = test::image_mean(out.image.mean);
  std::printf("caustic of a plane mirror / closed form = %.4f\n", radiance * std::numbers::pi / 1.5);
  EXPECT_NEAR(radiance * std::numbers::pi / 1.5, 1, 0.005);
}

TEST(caustic, flux_on_the_floor_of_cornell_spheres_agrees_with_path_tracing) {
  const SceneDescription scene = floor_and_balls();
  const auto pixels = floor_pixels(test::compiled(scene, 64, 64));
  ASSERT_GT(pixels.size(), 500u);
  // Paths of two edges are direct light alone. With the same direct estimator and random numbers, the difference is the
  // caustic.
  const double path = floor_sum(scene, pixels, "path", 17, 2048) - floor_sum(scene, pixels, "path", 2, 2048);
  const double photons =
      floor_sum(scene, pixels, "photonmapper", 17, 64) - floor_sum(scene, pixels, "photonmapper", 2, 64);
  std::printf("caustic flux on the floor: photon mapper / path = %.4f\n", photons / path);
  EXPECT_GT(path, 0);
  EXPECT_NEAR(photons / path, 1.0, 0.03);
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
