// Light that an integrator cannot find. Tests compare the table of routes with hand-worked ones, and the survey's share
// with closed forms and with the light missing in images.

#include "renderer/integrators/light_survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/light_routes.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::add_bsdf;
using test::add_shape;

/// Without volprim_rf_basic, which misses all light.
std::set<std::string> who_misses(const LightRoute& route) {
  std::set<std::string> names;
  for (const LightFinder& finder : light_finders())
    if (!finder.finds(route)) names.emplace(finder.integrator);
  EXPECT_EQ(names.erase("volprim_rf_basic"), 1u);
  return names;
}

// Routes go from the light to the camera. Next-event estimation joins a light to an adjacent scattering vertex, D or G.
// Light tracing joins the camera to an adjacent one. bdpt also joins two in a row. Photons are found on D.
TEST(light_routes, are_found_as_the_definitions_of_the_integrators_say) {
  using Names = std::set<std::string>;
  const Names deterministic{"direct", "whitted"};
  EXPECT_EQ(who_misses({false, ""}), Names{});
  EXPECT_EQ(who_misses({false, "D"}), Names{});
  EXPECT_EQ(who_misses({true, "D"}), Names{});
  EXPECT_EQ(who_misses({true, "DD"}), deterministic);
  EXPECT_EQ(who_misses({false, "S"}), Names{"ptracer"});
  EXPECT_EQ(who_misses({false, "DS"}), (Names{"ptracer", "direct"}));
  EXPECT_EQ(who_misses({false, "SD"}), deterministic);
  EXPECT_EQ(who_misses({true, "SD"}), (Names{"path", "volpath", "direct", "whitted"}));
  EXPECT_EQ(who_misses({true, "ND"}), (Names{"path", "direct", "whitted"}));
  EXPECT_EQ(who_misses({true, "DN"}), (Names{"ptracer", "direct"}));
  EXPECT_EQ(who_misses({true, "SG"}), (Names{"path", "volpath", "photonmapper", "sppm", "direct", "whitted"}));
  EXPECT_EQ(who_misses({true, "SDS"}), (Names{"path", "volpath", "bdpt", "ptracer", "direct", "whitted"}));
  EXPECT_EQ(who_misses({true, "SDDS"}), (Names{"path", "volpath", "ptracer", "direct", "whitted"}));
  EXPECT_EQ(who_misses({true, "SDSD"}), (Names{"path", "volpath", "direct", "whitted"}));
  EXPECT_EQ(who_misses({false, "SDS"}), (Names{"ptracer", "direct", "whitted"}));
}

std::optional<LostLight> lost_by(const char* integrator, const SceneDescription& description, int size) {
  const Scene scene = test::compiled(description, size, size);
  RenderPlan plan = plan_render(analyse(scene), with_integrator(description.integrator, integrator), RenderJob{});
  find_lost_light(scene, plan);
  return plan.lost_light;
}

double share_lost(const char* integrator, const SceneDescription& description, int size = 32) {
  const std::optional<LostLight> lost = lost_by(integrator, description, size);
  return lost ? lost->share : 0;
}

/// A furnace of radiance 2 with a mirror ball of radius .5, fully visible in parallel rays over [-1, 1]^2.
SceneDescription furnace_with_a_mirror() {
  SceneDescription scene = test::furnace(0.5, 1, 32);
  scene.shapes[0].to_world = Transform::scale(Vec3d(3));
  add_shape(scene, SphereDescription{{0, 0, 0}, 0.5}, {}, add_bsdf(scene, ConductorDescription{}));
  scene.sensor.camera = OrthographicDescription{};
  scene.sensor.to_world = Transform::look_at({0, 0, 1.5}, {0, 0, 0}, {0, 1, 0});
  return scene;
}

// Everything has the same brightness, so light tracing lacks the ball's share of the image, pi/4 (.5)^2 = .1963. Path
// tracers lack nothing.
TEST(light_survey, light_tracing_lacks_the_part_of_a_furnace_that_a_mirror_covers) {
  const SceneDescription scene = furnace_with_a_mirror();
  const double covered = std::numbers::pi / 4 * 0.25;
  EXPECT_NEAR(share_lost("ptracer", scene) / covered, 1, 0.04);
  EXPECT_NEAR(test::image_mean(test::render(scene, "ptracer", test::job_with(32)).image.mean), 2 * (1 - covered), 0.02);
  for (const char* whole : {"path", "bdpt", "volpath", "photonmapper"})
    EXPECT_FALSE(lost_by(whole, scene, 32)) << whole;
  EXPECT_THAT(lost_by("ptracer", scene, 32)->text(), testing::EndsWith("of the image's light: 'path' finds it"));
}

// Without shapes every integrator shows the sky itself.
TEST(light_survey, a_sky_alone_is_lost_to_nobody) {
  SceneDescription scene;
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
  test::set_camera(scene, {}, 40, 16);
  for (const char* name : {"path", "bdpt", "volpath", "ptracer", "photonmapper", "whitted", "direct"}) {
    EXPECT_FALSE(lost_by(name, scene, 16)) << name;
    const test::Rendered out = test::render(scene, name, test::job_with(4));
    EXPECT_THAT(out.image.mean.rgb, testing::Each(testing::FloatNear(1, 1e-6f))) << name;
    EXPECT_THAT(out.stats.losses, testing::IsEmpty()) << name;
  }
}

/// A room lit by a point, with a ball of `model` in it.
SceneDescription room_with_a_point(const decltype(BsdfDescription::model)& model) {
  SceneDescription scene = test::room(16, false);
  scene.shapes.pop_back();  // its light
  scene.emitters.push_back({{}, "", PointLightDescription{{0, 0.9, 0}, RgbD(1)}});
  add_shape(scene, SphereDescription{{0.3, -0.5, 0.2}, 0.35}, {}, add_bsdf(scene, model));
  scene.integrator.method = PathDescription{-1, 24, false};
  return scene;
}

DielectricDescription glass() {
  DielectricDescription model;
  model.int_ior = 1.5;
  model.ext_ior = 1.0;
  return model;
}

struct Lossy {
  const char* name;
  SceneDescription scene;
  std::set<std::string> lossy;  ///< among path, volpath, bdpt, ptracer and photonmapper
};

std::vector<Lossy> lossy_scenes() {
  PlasticDescription coat;
  coat.diffuse_reflectance = RgbD(0.1);
  SceneDescription shallow = room_with_a_point(glass());
  shallow.integrator.method = PathDescription{2, 24, false};
  SceneDescription light = test::room(16, true);
  light.integrator.method = PathDescription{-1, 24, false};
  return {
      {"a point's light through glass", room_with_a_point(glass()), {"path", "volpath", "ptracer"}},
      {"a point's light off a mirror", room_with_a_point(ConductorDescription{}), {"path", "volpath", "ptracer"}},
      {"a point's light off a clear coat", room_with_a_point(coat), {"path", "volpath", "ptracer"}},
      {"a point's light among what only scatters", room_with_a_point(DiffuseDescription{}), {}},
      {"two edges, too few for a caustic", shallow, {}},
      {"a light's light by mirror and glass", light, {"ptracer"}},
  };
}

// bdpt misses the caustics of a point light that are seen in a mirror or through glass. Here they are too faint to
// count, and its image has the photon mapper's mean.
TEST(light_survey, names_exactly_the_integrators_whose_images_lack_light) {
  for (const Lossy& row : lossy_scenes()) {
    const auto mean = [&](const char* integrator, int spp) {
      return test::image_mean(test::render(row.scene, integrator, test::job_with(spp, 1'000'000)).image.mean);
    };
    for (const char* name : {"path", "volpath", "bdpt", "ptracer", "photonmapper"})
      EXPECT_EQ(share_lost(name, row.scene, 16) > 0, row.lossy.contains(name)) << row.name << ", " << name;
    const double whole = mean("photonmapper", 256);
    for (const auto& [name, spp, noise] : {std::tuple{"path", 2048, 0.006}, {"ptracer", 128, 0.03}}) {
      const double share = share_lost(name, row.scene, 16), lacks = 1 - mean(name, spp) / whole;
      std::printf("%s, %s: lacks %.4f, survey %.4f\n", row.name, name, lacks, share);
      EXPECT_NEAR(lacks, share, noise + 0.3 * share) << row.name << ", " << name;
    }
  }
}

TEST(light_survey, advises_an_integrator_that_shows_the_light) {
  SceneDescription scene = room_with_a_point(glass());
  const std::optional<LostLight> lost = lost_by("path", scene, 16);
  ASSERT_TRUE(lost);
  EXPECT_THAT(lost->finders, testing::Contains("photonmapper"));
  EXPECT_THAT(lost->finders, testing::Not(testing::Contains(testing::AnyOf("path", "volpath", "ptracer"))));
  EXPECT_THAT(lost->text(), testing::StartsWith("integrator 'path' cannot find light of lights without size that"));
}

// In fog no integrator finds light of a point light that glass refracts.
TEST(light_survey, advises_nobody_where_glass_stands_in_fog) {
  SceneDescription scene = room_with_a_point(glass());
  scene.media.push_back({{}, "fog", HomogeneousDescription{}});
  auto& fog = std::get<HomogeneousDescription>(scene.media[0].model);
  fog.sigma_t = RgbD(0.3);
  fog.albedo = RgbD(0.9);
  scene.sensor.medium = MediumIndex{0};
  scene.shapes.back().exterior = MediumIndex{0};
  const std::optional<LostLight> lost = lost_by("volpath", scene, 16);
  ASSERT_TRUE(lost);
  EXPECT_THAT(lost->finders, testing::IsEmpty());
  EXPECT_THAT(lost->text(), testing::EndsWith(": no integrator of this program finds all light of this scene"));
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
