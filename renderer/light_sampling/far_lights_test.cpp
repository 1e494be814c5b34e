// Lights so far away that a direction in single precision misses the lit place. Light paths are aimed at visible places
// and known by a point of their line near the target. Their rays begin at the point up to which they meet nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/light_sampling/test_lights.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/scene/find_clear_ways.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

const Vec3d towards_light{0.36, 0.8, -0.48};

struct FarLight {
  const char* name;
  Light light;
  double intensity;  ///< towards the origin, W sr^-1
};

/// Far lights; those with a size have a thousandth of their distance.
std::vector<FarLight> far_lights(double distance) {
  const Vec3f at(towards_light * distance), down(-towards_light);
  const auto size = static_cast<float>(1e-3 * distance);
  const Frame<float> across(down);
  return {
      {"point", PointLight<float>{at, Rgb(1)}, 1},
      {"spot", spot_light(at, down, Rgb(1), 0.1, 0.2), 1},
      {"sphere", SphereLight<float>{at, size, 1, Rgb(1)}, std::numbers::pi * double{size} * double{size}},
      {"disk", DiskLight<float>{at, across.s * size, across.t * size, down, pi * size * size, Rgb(1), told_by_corner},
       std::numbers::pi * double{size} * double{size}}};
}

TEST(far_lights, guided_photons_carry_what_crosses_what_is_seen_and_begin_before_it) {
  // A ball of radius r receives pi r^2 of the passing irradiance. Half of the photons go into one of the two visible
  // balls. The test detects an error of 6 % in any ball.
  constexpr int draws = 200'000;
  const std::vector<ProjectionTarget> seen{{{0, 0, 0}, 0.5f}, {{3, 0, 1}, 2}};
  const ProjectionTarget others{{1, 1, 0}, 20};
  const ClearWays ways{{others}, {}};
  const std::vector<ProjectionTarget> crossed{{{0, 0, 0}, 0.3f}, {{0.1f, 0, 0}, 0.39f}, {{3, 0, 1}, 1.5f}};
  for (const double distance : {1e4, 1e6, 1e8, 1e12})
    for (const FarLight& area_light : far_lights(distance)) {
      test::Lights lights({area_light.light});
      lights.scene.guide_emission(EmissionGuiding(lights.lights, seen, {}, &ways));
      ASSERT_TRUE(lights.scene.has_guide());
      std::vector<double> sum(crossed.size()), squares(crossed.size());
      for (int i = 0; i < draws; ++i) {
        test::Random r(8100, static_cast<std::uint64_t>(i));
        const Vec2<float> u = r.next2();
        const LightStart e = lights.scene.emit(0.5f, u, r.next2());
        if (!(e.flux.x > 0)) continue;
        const bool ahead = e.is_ahead > 0;
        if (distance > 1e5 && ahead) {
          ASSERT_GE(length(e.ahead - others.center), others.radius) << area_light.name;
        }
        for (std::size_t k = 0; k < crossed.size(); ++k) {
          const Vec3d from(ahead ? e.ahead : e.at.p);
          if (length(cross(Vec3d(crossed[k].center) - from, Vec3d(e.direction))) > double{crossed[k].radius}) continue;
          sum[k] += double{e.flux.x};
          squares[k] += double{e.flux.x} * double{e.flux.x};
        }
      }
      for (std::size_t k = 0; k < crossed.size(); ++k) {
        const double mean = sum[k] / draws, error = std::sqrt((squares[k] / draws - mean * mean) / draws);
        const double solid_angle = std::numbers::pi * std::pow(double{crossed[k].radius} / distance, 2);
        EXPECT_NEAR(mean, area_light.intensity * solid_angle, 4 * error + 3e-3 * mean)
            << area_light.name << distance << k;
        EXPECT_LT(error, 0.015 * mean) << area_light.name << distance << k;
      }
    }
}

// --- whole renders ---------------------------------------------------------------------------------------------------

/// A floor and a glass ball over it under a point light at this distance, with the irradiance of a beam.
SceneDescription glass_under_point(double distance) {
  SceneDescription scene;
  test::add_shape(scene, RectangleDescription{}, Transform::rotate({1, 0, 0}, -90) * Transform::scale(Vec3d(4)),
                  test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)}));
  test::add_shape(scene, SphereDescription{{0, 1.2, 0}, 0.7}, {}, test::add_bsdf(scene, DielectricDescription{}));
  scene.emitters.push_back({{}, "", PointLightDescription{towards_light * distance, RgbD(4 * distance * distance)}});
  test::set_camera(scene, Transform::look_at({0, 7, 5}, {0, 0, 0}, {0, 1, 0}), 30, 16);
  return scene;
}
double mean_of(const SceneDescription& scene, const char* integrator, std::int64_t spp, std::int64_t photons) {
  return test::image_mean(test::render(scene, integrator, test::job_with(spp, photons)).image.mean);
}

TEST(far_lights, light_floor_and_caustic_as_near_ones_do) {
  // From 1e4 away unguided rays still hit. Without the light that the glass gathers the mean would be 9 % less.
  for (const auto& [integrator, spp] : {std::pair{"photonmapper", 64}, {"bdpt", 64}, {"ptracer", 256}}) {
    const double near = mean_of(glass_under_point(1e4), integrator, spp, 50'000);
    for (const double distance : {1e7, 1e9, 1e12})
      EXPECT_NEAR(mean_of(glass_under_point(distance), integrator, spp, 50'000), near, 0.015 * near)
          << integrator << " from " << distance;
  }
}

TEST(far_lights, light_nothing_behind_what_is_in_their_way) {
  for (const bool endless : {false, true}) {
    SceneDescription scene = glass_under_point(1e9);
    const Transform lid = Transform::translate({0, 1e5, 0}) * Transform::rotate({1, 0, 0}, -90);
    const BsdfIndex grey = test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)});
    if (endless)
      test::add_shape(scene, PlaneDescription{}, lid, grey);
    else
      test::add_shape(scene, RectangleDescription{}, lid * Transform::scale(Vec3d(1e5)), grey);
    for (const char* integrator : {"photonmapper", "bdpt", "ptracer"})
      EXPECT_EQ(mean_of(scene, integrator, 4, 10'000), 0) << integrator << endless;
  }
}

TEST(clear_ways, are_outside_of_all_but_a_lights_own_convex_shape) {
  SceneDescription scene = glass_under_point(100);  // within 4 sqrt(2) of the origin and at most 1.9 high
  const BsdfIndex black = test::add_bsdf(scene, DiffuseDescription{RgbD(0)});
  const auto add_light = [&](const decltype(ShapeDescription::geometry)& geometry, const Transform& to_world) {
    test::add_shape(scene, geometry, to_world, black).radiance = RgbD(1);
  };
  add_light(SphereDescription{{0, 1000, 0}, 1}, {});
  const ClearWays with_ball = find_clear_ways(SceneParts(scene, 16, 16));
  ASSERT_EQ(with_ball.others.size(), 2u);
  EXPECT_LT(with_ball.others[0].radius, 6.5f) << "of the ball's own";
  EXPECT_GT(with_ball.others[1].radius, 400) << "of the point's";

  scene.shapes.pop_back();
  add_light(CubeDescription{}, Transform::translate({0, 1000, 0}));
  test::add_shape(scene, PlaneDescription{}, Transform::translate({0, 0, -50}), black);
  const ClearWays with_cube = find_clear_ways(SceneParts(scene, 16, 16));
  ASSERT_EQ(with_cube.others.size(), 7u);
  for (std::size_t face = 0; face < 6; ++face) EXPECT_LT(with_cube.others[face].radius, 6.5f) << face;
  EXPECT_TRUE(with_ball.walls.empty());
  EXPECT_EQ(with_cube.walls.size(), 1u);
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
