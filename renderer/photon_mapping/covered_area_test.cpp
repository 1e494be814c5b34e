// Gathers beside objects that stand on a surface: no light lands under them, and none is missing beside them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// A room with boxes on the floor and on each other, seen from close by. Every surface emits 1 and has albedo 0.5, so
/// the radiance is 2 everywhere.
SceneDescription furnace_with_boxes(int size) {
  SceneDescription scene;
  const BsdfIndex grey = test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)});
  const BsdfIndex of_boxes = test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)});
  const auto emit = [](ShapeDescription& shape) { shape.radiance = RgbD(1); };
  ShapeDescription& walls = test::add_shape(scene, CubeDescription{}, {}, grey);
  walls.flip_normals = true;
  emit(walls);
  const auto box = [&](const Vec3d& at, const Vec3d& half, double degrees) {
    emit(test::add_shape(scene, CubeDescription{},
                         Transform::translate(at) * Transform::rotate({0, 1, 0}, degrees) * Transform::scale(half),
                         of_boxes));
  };
  box({-0.4, -0.8, -0.2}, {0.3, 0.2, 0.25}, 20);
  box({-0.4, -0.5, -0.2}, {0.15, 0.1, 0.15}, 50);
  box({0.45, -0.7, 0.2}, {0.2, 0.3, 0.2}, -30);
  test::set_camera(scene, Transform::look_at({0, 0.6, 0.8}, {0, -0.85, -0.1}, {0, 1, 0}), 65, size);
  scene.integrator.method = PathDescription{-1, 24, false};
  return scene;
}

/// Worst relative error of the global map over blocks. The expected value is light of at least two bounces: 2 less the
/// emission 1 less one bounce 0.5.
double worst_block_of_map(SceneDescription scene) {
  RenderJob job = test::job_with(16, 8'000'000);
  job.view = Aov::global;
  scene = test::with_indirect(std::move(scene), IndirectLight::map, 0.15);
  const Image image = test::render(scene, "photonmapper", job).image.mean;
  double worst = 0;
  constexpr int block = 4;
  for (int y = 0; y < image.height; y += block)
    for (int x = 0; x < image.width; x += block)
      worst = std::max(worst, std::abs(test::block_mean(image, x, y, block, block) / 0.5 - 1));
  return worst;
}

TEST(box_feet, a_furnace_is_as_bright_beside_what_stands_in_it) {
  EXPECT_LT(worst_block_of_map(furnace_with_boxes(48)), 0.03);
}

TEST(box_feet, what_lets_light_through_covers_nothing) {
  // Glass that neither bends nor reflects light: photons land under it.
  SceneDescription scene = furnace_with_boxes(48);
  DielectricDescription nothing;
  nothing.int_ior = nothing.ext_ior = 1;
  for (std::size_t i = 1; i < scene.shapes.size(); ++i) scene.shapes[i].radiance.reset();
  scene.bsdfs[1].model = nothing;
  EXPECT_LT(worst_block_of_map(scene), 0.03);
}

TEST(box_feet, a_light_inside_keeps_its_light) {
  // A closed box around the camera and a light: the floor that it stands on must look as if it were not covered.
  SceneDescription scene;
  const BsdfIndex grey = test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)});
  ShapeDescription& walls = test::add_shape(scene, CubeDescription{}, Transform::scale(Vec3d(3)), grey);
  walls.flip_normals = true;
  walls.radiance = RgbD(1);
  // The box's sides face outward and are black from inside, so that the light shines on the floor alone.
  test::add_shape(scene, CubeDescription{}, Transform::translate({0.5, -2, 0.5}), grey);
  ShapeDescription& light = test::add_shape(scene, SphereDescription{{0.5, -1.5, 0.5}, 0.2}, {}, grey);
  light.radiance = RgbD(5);
  test::set_camera(scene, Transform::look_at({0.5, -1.6, 1.3}, {0.5, -3, 0.5}, {0, 1, 0}), 60, 16);
  scene.integrator.method = PathDescription{-1, 24, false};
  const auto path = test::render(scene, "path", test::job_with(1024));
  const auto maps =
      test::render(test::with_indirect(scene, IndirectLight::map, 0.1), "photonmapper", test::job_with(64, 2'000'000));
  EXPECT_NEAR(test::image_mean(maps.image.mean) / test::image_mean(path.image.mean), 1, 0.01);
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
