// Compiling a description: orientation, cameras, light choice, facts.

#include "renderer/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/integrators/test_scenes.h"
#include "renderer/kernels/lights.h"
#include "renderer/lanes/test_random.h"
#include "renderer/light_sampling/light_table.h"
#include "renderer/planning/scene_facts.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/sensor/film.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline renderer_scene {
namespace {

TEST(scene, cube_normals_point_outward_and_flip) {
  for (const bool flip : {false, true}) {
    SceneDescription d;
    test::add_shape(d, CubeDescription{}, Transform::translate({3, 0, 0}) * Transform::scale({1, 2, 3}),
                    test::add_bsdf(d, DiffuseDescription{}))
        .flip_normals = flip;
    const Scene scene = test::compiled(d, 4, 4);
    ASSERT_EQ(scene.surfaces.size(), 6u);
    float area = 0;
    for (const Surface& surface : scene.surfaces) {
      const auto& quad = std::get<Quad>(surface.geometry);
      const Vec3f middle =  // seen from the cube's, which is the origin
          quad.corner + quad.edge_u * 0.5f + quad.edge_v * 0.5f;
      EXPECT_EQ(dot(quad.normal, middle) > 0, !flip);
      area += quad.area;
    }
    EXPECT_NEAR(area, 2 * (2 * 4 + 4 * 6 + 2 * 6), 1e-4f);  // faces of a 2 x 4 x 6 box
  }
}

TEST(scene, a_mirroring_transform_keeps_the_normal_on_its_side) {
  // Mitsuba transforms normals by the inverse transpose: scaling x by -1 leaves a rectangle's +z normal where it was.
  SceneDescription d;
  test::add_shape(d, RectangleDescription{}, Transform::scale({-1, 1, 1}), test::add_bsdf(d, DiffuseDescription{}));
  EXPECT_EQ(std::get<Quad>(test::compiled(d, 4, 4).surfaces[0].geometry).normal, Vec3f(0, 0, 1));
}

TEST(camera, looks_through_the_pixels_mitsuba_does) {
  // The camera is at the origin and looks down -z with +y up, 90 degrees along x, twice as wide as high. The image's
  // left edge is world -x (local +x is left), the top is +y at half the tangent.
  SceneDescription d;
  test::set_camera(d, Transform::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}), 90, 10);
  // The middle of the corner pixel is half a pixel, 1/20 and 1/10 of the way to the centre, inside the edge.
  SceneView view;
  view.camera = compile_camera(d.sensor, 20, 10, {});
  const Vec3f top_left = test::ray_through_pixel(view, 0, 0).direction;
  EXPECT_NEAR(top_left.x / -top_left.z, -0.95f, 1e-6f);
  EXPECT_NEAR(top_left.y / -top_left.z, 0.45f, 1e-6f);
  const Vec3f bottom_right = test::ray_through_pixel(view, 19, 9).direction;
  EXPECT_NEAR(length(bottom_right - Vec3f(-top_left.x, -top_left.y, top_left.z)), 0, 1e-6f);
  EXPECT_NEAR(length(bottom_right), 1, 1e-6f);
}

TEST(camera, rays_start_on_the_near_plane) {
  SceneDescription d;
  test::set_camera(d, Transform::look_at({0, 0, 150}, {0, 0, 0}, {0, 1, 0}), 52.63, 10);
  std::get<PerspectiveDescription>(d.sensor.camera).near_clip = 100.1;
  SceneView view;
  view.camera = compile_camera(d.sensor, 10, 10, {});
  const Vec3f origin = test::ray_through_pixel(view, 0, 0).origin;
  EXPECT_NEAR(origin.z, 49.9f, 1e-4f);
  EXPECT_NEAR(origin.x, -0.9f * 49.505f, 0.02f);  // 100.1 tan(26.315 degrees) = 49.505, half a pixel inside the edge
}

TEST(camera, every_path_of_a_task_is_one_sample_of_one_pixel) {
  // Divided in single precision, which must come out as in integers up to the 2^20 paths that a task may have.
  struct Case {
    int width, height;
    std::uint32_t samples;
    int grid;
  };
  SceneView view;
  view.camera.right = {1, 0, 0};
  view.camera.up = {0, 1, 0};
  view.camera.forward = {0, 0, 1};
  view.camera.far = 1;
  for (const Case& c :
       {Case{16, 16, 1, 0}, Case{16, 16, 3, 0}, Case{5, 13, 7, 0}, Case{1, 1, 11, 0}, Case{16, 9, 99, 0},
        Case{13, 16, 1023, 0}, Case{16, 16, 4096, 0}, Case{16, 16, 4095, 0}, Case{7, 5, 200, 3}}) {
    CameraTask task{};
    task.x0 = 48;
    task.y0 = 32;
    task.x1 = 48 + c.width;
    task.y1 = 32 + c.height;
    task.first_sample = 10;
    task.samples = c.samples;
    task.seed = 12345;
    task.grid = c.grid;
    for (std::uint32_t path = 0; path < task.paths(); ++path) {
      const CameraRay<float> ray = camera_rays<float>(view, task, path);
      const std::uint32_t pixel = path / c.samples, width = task.tile_width();
      ASSERT_EQ(ray.index, 10 + path % c.samples);
      ASSERT_EQ(ray.key, mix_bits(mix_bits((32 + pixel / width) << 16 | (48 + pixel % width)) + 12345u));
      if (c.grid == 0) continue;
      // The camera looks along +z with tangents 1 at one pixel an image: through (2x - 1, 1 - 2y) for the point (x, y).
      const auto cell = static_cast<int>(ray.index) % (c.grid * c.grid);
      const float x = 48 + static_cast<float>(pixel % width) +
                      (static_cast<float>(cell % c.grid) + 0.5f) / static_cast<float>(c.grid);
      const float y = 32 + static_cast<float>(pixel / width) +
                      (static_cast<float>(cell / c.grid) + 0.5f) / static_cast<float>(c.grid);
      ASSERT_NEAR(ray.direction.x / ray.direction.z, 2 * x - 1, 1e-4f);
      ASSERT_NEAR(ray.direction.y / ray.direction.z, 1 - 2 * y, 1e-4f);
    }
  }
}

TEST(scene, refuses_shapes_whose_area_vanishes_or_overflows) {
  for (const double scale : {1e-20, 1e20}) {
    SceneDescription d;
    d.files = {"s.xml"};
    // Beside two of ordinary size, which keep the scene's unit of length.
    const Transform ahead = Transform::translate({0, 0, 5});
    const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{});
    for (int i = 0; i < 2; ++i) test::add_shape(d, RectangleDescription{}, ahead, grey);
    test::add_shape(d, RectangleDescription{}, ahead * Transform::scale(Vec3d(scale)), grey).loc = {0, 3, 5};
    try {
      const Scene scene = test::compiled(d, 4, 4);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(error.summary(), "s.xml:3:5: error: the shape's area is outside what single precision can hold");
    }
  }
}

TEST(scene, lights_are_chosen_half_by_flux_half_evenly) {
  SceneDescription d;
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(3)}});
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(0)}});
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(1)}});
  d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 0}, RgbD(0)}});
  const Scene scene = test::compiled(d, 4, 4);
  // Over 4096 numbers in the middles of equal cells, exactly: the alias table's thresholds are multiples of a quarter.
  std::vector<double> chosen(4);
  for (int i = 0; i < 4096; ++i) {
    const LightSampling<float> choice = choose_light<float>(scene.view(), (static_cast<float>(i) + 0.5f) / 4096);
    chosen[choice.light] += 1.0 / 4096;
    EXPECT_NEAR(choice.probability, choice.light == 0 ? 0.625f : 0.375f, 1e-7f);
  }
  EXPECT_EQ(chosen, (std::vector<double>{0.625, 0, 0.375, 0}));  // (3/4 + 1/2) / 2; never the dark ones
  EXPECT_NE(choose_light<float>(scene.view(), std::nextafter(1.0f, 0.0f)).light % 2, 1u);
}

TEST(scene, an_alias_table_of_many_lights_holds_their_shares) {
  // The share of slot i is its own part plus the parts that others' slots give it: n p_i = threshold_i + sum (1 -
  // threshold_j).
  std::vector<Light> lights;
  double total = 0, shining = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const float strength = i % 7 == 0 ? 0.0f : std::pow(10.0f, 6 * test::Random(61, i).next() - 3);
    total += static_cast<double>(strength);
    if (strength > 0) ++shining;
    lights.emplace_back(PointLight<float>{{}, Rgb(strength)});
  }
  const std::vector<LightWords> table = light_table(lights);
  std::vector<double> share(1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    share[i] += static_cast<double>(table[i].alias_threshold);
    if (table[i].alias != i) share[table[i].alias] += 1 - static_cast<double>(table[i].alias_threshold);
  }
  for (std::size_t i = 0; i < 1000; ++i) {
    const auto strength = static_cast<double>(std::get<PointLight<float>>(lights[i]).intensity.x);
    const double expected = strength > 0 ? (strength / total + 1 / shining) / 2 : 0;
    EXPECT_NEAR(static_cast<double>(table[i].probability), expected, 1e-6 * expected);
    EXPECT_NEAR(share[i], 1000 * expected, 1e-5 * (1 + 1000 * expected)) << i;
    if (i % 7 == 0) {
      EXPECT_EQ(share[i], 0) << i;
    }
  }
}

TEST(scene, its_origin_is_the_middle_of_its_shapes) {
  // Shapes from 1e5 to 1e5 + 4 along x: what is near them has coordinates below 3 and the sixteen-millionth part of
  // that as rounding, not of 1e5. Camera and point light move along.
  SceneDescription d;
  const BsdfIndex grey = test::add_bsdf(d, DiffuseDescription{});
  test::add_shape(d, SphereDescription{{1e5 + 1, 0, 0}, 1}, {}, grey);
  test::add_shape(d, SphereDescription{{1e5 + 3, 0, 0}, 1}, {}, grey);
  d.emitters.push_back({{}, "", PointLightDescription{{1e5 + 2, 0.5, 3}, RgbD(1)}});
  test::set_camera(d, Transform::look_at({1e5 + 2, 0, 5}, {1e5 + 2, 0, 0}, {0, 1, 0}), 40, 4);
  const Scene scene = test::compiled(d, 4, 4);
  EXPECT_EQ(std::get<Sphere>(scene.surfaces[0].geometry).center, Vec3d(-1, 0, 0));
  EXPECT_EQ(std::get<Sphere>(scene.surfaces[1].geometry).center, Vec3d(1, 0, 0));
  EXPECT_EQ(std::get<PointLight<float>>(scene.lights[0]).position, Vec3f(0, 0.5f, 3));
  EXPECT_EQ(scene.view().camera.origin, Vec3f(0, 0, 5));
}

TEST(scene, one_large_or_distant_shape_does_not_move_its_origin) {
  SceneDescription d = test::room(4, true);
  const Vec3d ball = std::get<Sphere>(test::compiled(d, 4, 4).surfaces[6].geometry).center;
  test::add_shape(d, SphereDescription{{0, -1e7 - 1, 0}, 1e7}, {}, d.shapes[0].bsdf);
  test::add_shape(d, SphereDescription{{1e8, 0, 0}, 1}, {}, d.shapes[0].bsdf);
  const Scene scene = test::compiled(d, 4, 4);
  EXPECT_LT(length(std::get<Sphere>(scene.surfaces[6].geometry).center - ball), 1);
  EXPECT_LT(scene.view().coordinate_floor, 1);
}

TEST(scene, without_a_primitive_every_ray_misses) {
  // No shape at all, and a mesh whose only triangle has no area.
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(3);
  mesh->triangles = {{0, 1, 2}};
  for (const bool with_mesh : {false, true}) {
    SceneDescription d;
    if (with_mesh)
      test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "point.ply", true, false, mesh}, {},
                      test::add_bsdf(d, DiffuseDescription{}));
    d.emitters.push_back({{}, "", PointLightDescription{{0, 0, 1}, RgbD(1)}});
    test::set_camera(d, {}, 40, 4);
    for (const char* integrator : {"path", "photonmapper"})
      for (const Kernels& kernels : available_kernels()) {
        RenderJob job = test::job_with(2, 100);
        job.isa = kernels.isa;
        EXPECT_EQ(test::image_mean(test::render(d, integrator, job).image.mean), 0) << integrator << kernels.isa;
      }
  }
}

TEST(scene, is_small_up_to_the_limit_and_embrees_beyond) {
  const SceneDescription d = test::room(4, true);  // 6 rectangles, 2 balls
  EXPECT_TRUE(test::compiled(d, 4, 4, {}, 8).view().small);
  EXPECT_EQ(test::compiled(d, 4, 4, {}, 8).view().tracer, nullptr);
  EXPECT_FALSE(test::compiled(d, 4, 4, {}, 7).view().small);
  EXPECT_EQ(test::compiled(d, 4, 4).primitives, 8u);
}

TEST(facts, tell_what_a_scene_cannot_do) {
  const auto facts = [](const SceneDescription& d) { return analyse(SceneParts(d, 4, 4)); };
  EXPECT_FALSE(facts(test::floor_under_point_light(4)).diffuse_interreflection);
  EXPECT_FALSE(facts(test::floor_under_point_light(4)).lights_can_be_hit);
  EXPECT_TRUE(facts(test::furnace(0.5, 1, 4)).diffuse_interreflection);
  EXPECT_FALSE(facts(test::furnace(0, 1, 4)).any_diffuse);
  EXPECT_EQ(facts(test::room(4, false)).specular_surfaces, 0u);
  EXPECT_EQ(facts(test::room(4, true)).specular_surfaces, 2u);
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

TEST(film, has_a_mean_where_the_variance_is_beyond_a_float) {
  // Estimates 0 and 1e30: variance of the mean 2.5e59.
  Film film(1, 1);
  film.add(0, 0, RgbD(0), 1);
  film.add(0, 0, RgbD(1e30), 1);
  EXPECT_EQ(film.develop().mean.rgb[0], 5e29f);
  EXPECT_FALSE(film.develop().variance);
}

TEST(film, means_of_shared_passes_say_how_certain_the_images_mean_is) {
  // Two correlated pixels. Passes of 1 and 2 samples have the means 1 and 4 over both: variance 2, as above. From the
  // pixels alone it would be 2/2 and more.
  Film film(2, 1);
  film.add(0, 0, RgbD(0.5), 1);
  film.add(1, 0, RgbD(1.5), 1);
  film.end_shared_pass(1);
  EXPECT_FALSE(stored_mean_error(film.develop()));
  film.add(0, 0, RgbD(2), 2);
  film.end_shared_pass(2);  // not whole yet
  film.add(1, 0, RgbD(6), 2);
  film.end_shared_pass(2);
  const MeanError error = stored_mean_error(film.develop()).value();
  EXPECT_EQ(error.passes, 2);
  for (const double value : error.standard_error) EXPECT_NEAR(value, std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace photonproof::inline renderer_scene
