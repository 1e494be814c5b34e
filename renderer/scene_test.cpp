// Compiling a description: orientation, cameras, light choice, facts.

#include "renderer/scene.h"

#include <gtest/gtest.h>

#include "renderer/film.h"
#include "renderer/scene_facts.h"
#include "renderer/test_scenes.h"

namespace photonproof {
namespace {

TEST(scene, cube_normals_point_outward_and_flip) {
  for (const bool flip : {false, true}) {
    SceneDescription d;
    test::add_shape(d, CubeDescription{}, Transform::translate({3, 0, 0}) * Transform::scale({1, 2, 3}),
                    test::add_bsdf(d, DiffuseDescription{}))
        .flip_normals = flip;
    const Scene scene(d, 4, 4);
    ASSERT_EQ(scene.surfaces.size(), 6u);
    float area = 0;
    for (const Surface& surface : scene.surfaces) {
      const auto& quad = std::get<Quad>(surface.geometry);
      const Vec3f middle = quad.corner + quad.edge_u * 0.5f + quad.edge_v * 0.5f;
      EXPECT_EQ(dot(quad.normal, middle - Vec3f(3, 0, 0)) > 0, !flip);
      area += quad.area;
    }
    EXPECT_NEAR(area, 2 * (2 * 4 + 4 * 6 + 2 * 6), 1e-4f);  // faces of a 2 x 4 x 6 box
  }
}

TEST(scene, a_mirroring_transform_keeps_the_normal_on_its_side) {
  // Mitsuba transforms normals by the inverse transpose: scaling x by -1 leaves a rectangle's +z normal where it was.
  SceneDescription d;
  test::add_shape(d, RectangleDescription{}, Transform::scale({-1, 1, 1}), test::add_bsdf(d, DiffuseDescription{}));
  EXPECT_EQ(std::get<Quad>(Scene(d, 4, 4).surfaces[0].geometry).normal, Vec3f(0, 0, 1));
}

TEST(camera, looks_through_the_pixels_mitsuba_does) {
  // At the origin looking down -z with +y up, 90 degrees along x, twice as wide as high: the left edge of the image is
  // world -x (local +x is left), the top is +y at half the tangent.
  SceneDescription d;
  test::set_camera(d, Transform::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}), 90, 10);
  const Camera camera(d.sensor, 20, 10);
  const Vec3f top_left = camera.ray(0, 0).direction;
  EXPECT_NEAR(top_left.x / -top_left.z, -1, 1e-6f);
  EXPECT_NEAR(top_left.y / -top_left.z, 0.5f, 1e-6f);
  EXPECT_NEAR(length(camera.ray(20, 10).direction), 1, 1e-6f);
}

TEST(camera, rays_start_on_the_near_plane) {
  SceneDescription d;
  test::set_camera(d, Transform::look_at({0, 0, 150}, {0, 0, 0}, {0, 1, 0}), 52.63, 10);
  std::get<PerspectiveDescription>(d.sensor.camera).near_clip = 100.1;
  const Camera camera(d.sensor, 10, 10);
  EXPECT_NEAR(camera.ray(0, 0).origin.z, 49.9f, 1e-4f);
  EXPECT_NEAR(camera.ray(0, 0).origin.x, -49.5f, 0.02f);  // 100.1 tan(26.315 degrees) = 49.505
}

TEST(scene, refuses_shapes_whose_area_vanishes_or_overflows) {
  for (const double scale : {1e-20, 1e20}) {
    SceneDescription d;
    d.files = {"s.xml"};
    test::add_shape(d, RectangleDescription{}, Transform::scale(Vec3d(scale)), test::add_bsdf(d, DiffuseDescription{}))
        .loc = {0, 3, 5};
    try {
      const Scene scene(d, 4, 4);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(error.summary(), "s.xml:3:5: error: the shape's area is outside what single precision can hold");
    }
  }
}

TEST(scene, lights_are_chosen_by_flux) {
  SceneDescription d;
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(3)}});
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(0)}});
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(1)}});
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(0)}});
  const Scene scene(d, 4, 4);
  EXPECT_EQ(scene.choose_light(0).index, 0u);
  EXPECT_EQ(scene.choose_light(0.74f).index, 0u);
  EXPECT_EQ(scene.choose_light(0.76f).index, 2u);
  EXPECT_EQ(scene.choose_light(std::nextafter(1.0f, 0.0f)).index, 2u);  // never the dark ones
  EXPECT_NEAR(scene.choose_light(0.76f).probability, 0.25f, 1e-7f);
}

TEST(facts, tell_what_a_scene_cannot_do) {
  const auto facts = [](const SceneDescription& d) { return analyse(Scene(d, 4, 4)); };
  EXPECT_FALSE(facts(test::floor_under_point_light(4)).diffuse_interreflection);
  EXPECT_FALSE(facts(test::floor_under_point_light(4)).any_light_surface);
  EXPECT_TRUE(facts(test::furnace(0.5, 1, 4)).diffuse_interreflection);
  EXPECT_FALSE(facts(test::furnace(0, 1, 4)).any_diffuse);
  EXPECT_FALSE(facts(test::room(4, false)).any_specular);
  EXPECT_TRUE(facts(test::room(4, true)).any_specular);
}

TEST(film, means_and_variance_of_the_mean_follow_the_weights) {
  // Estimates 1 (weight 1) and 4 (weight 2): mean 3; sum w (x-m)^2 = 4 + 2 = 6, over (n-1) sum w = 3: variance 2.
  Film film(1, 1);
  EXPECT_EQ(film.unsampled_pixels(), 1u);
  film.add(0, 0, RgbD(1), 1);
  EXPECT_FALSE(film.develop().variance);
  film.add(0, 0, RgbD(4), 2);
  EXPECT_EQ(film.develop().mean.rgb[0], 3);
  EXPECT_NEAR(film.develop().variance->rgb[1], 2, 1e-6f);
}

}  // namespace
}  // namespace photonproof
