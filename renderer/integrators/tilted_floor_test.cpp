// Shading normals that differ from their face's, by closed forms and by integrators that must agree. The scene is two
// squares at a right angle; one is a mesh whose normals tilt towards the other. Without the correction of light paths
// (scattering.h) the photon mapper is 26 % too bright at 20 degrees and 76 % at 45.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"

namespace photonproof::inline renderer_integrators {
namespace {

/// Values from harness/oracles/tilted_floor.py. `view_factor` is the mean over one square of (1/pi) int cos cos / d^2
/// over the other. `sideways` is the same for the direction across the square's edge in place of its normal.
constexpr double view_factor = 0.200044, sideways = 0.305344;
constexpr double floor_albedo = 0.6, wall_albedo = 0.8, irradiance = 3;

/// The square 0 < x, y < 1 at z = 0, facing up, with normals that tilt by that angle towards +x.
std::shared_ptr<const TriangleMesh> leaning_floor(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(4);
  mesh->positions[0] = {0, 0, 0};
  mesh->positions[1] = {1, 0, 0};
  mesh->positions[2] = {1, 1, 0};
  mesh->positions[3] = {0, 1, 0};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh->normals.assign(4, Vec3f(Vec3d(std::sin(a), 0, std::cos(a))));
  return mesh;
}

/// The tilted floor and a wall at x = 1 that faces it. The light reaches one of them, the camera sees the other. Paths
/// are light, one square, the other, camera.
SceneDescription squares(double degrees, const Vec3d& light, const Transform& camera) {
  SceneDescription d;
  const BsdfIndex below = test::add_bsdf(d, DiffuseDescription{RgbD(floor_albedo)});
  const BsdfIndex beside = test::add_bsdf(d, DiffuseDescription{RgbD(wall_albedo)});
  test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "", false, false, leaning_floor(degrees)}, {},
                  below);
  test::add_shape(
      d, RectangleDescription{},
      Transform::translate({1, 0.5, 0.5}) * Transform::rotate({0, 1, 0}, -90) * Transform::scale(Vec3d(0.5)), beside);
  d.emitters.push_back({{}, "", DirectionalLightDescription{light, RgbD(irradiance)}});
  d.sensor.camera = OrthographicDescription{};
  d.sensor.to_world = camera * Transform::scale({0.5, 0.5, 1});
  d.sensor.film.width = d.sensor.film.height = 16;
  d.integrator.method = PathDescription{3, 24, false};
  return d;
}
SceneDescription wall_by_floor(double degrees) {
  return squares(degrees, {0, 0, -1}, Transform::look_at({-1, 0.5, 0.5}, {1, 0.5, 0.5}, {0, 0, 1}));
}
SceneDescription floor_by_wall(double degrees) {
  return squares(degrees, {1, 0, 0}, Transform::look_at({0.5, 0.5, 3}, {0.5, 0.5, 0}, {0, 1, 0}));
}

double mean_by(const SceneDescription& scene, const char* integrator, std::int64_t spp, std::int64_t photons = 0) {
  return test::image_mean(test::render(scene, integrator, test::job_with(spp, photons)).image.mean);
}

double photons_of_radius(SceneDescription scene, double radius, std::int64_t photons) {
  PhotonMapperDescription method;
  static_cast<PathLimits&>(method) = scene.integrator.limits();
  method.global_radius = method.caustic_radius = radius;
  scene.integrator.method = method;
  return mean_by(scene, "photonmapper", 256, 4 * photons);  // with discs this small every sample counts
}
/// Extrapolates to radius 0 from two radii: the loss at edges is in proportion to the radius.
double photons_at_radius_zero(const SceneDescription& scene, double radius, std::int64_t photons) {
  return 2 * photons_of_radius(scene, radius / 2, photons) - photons_of_radius(scene, radius, photons);
}

void expect_mean(const SceneDescription& scene, double expected, double radius, std::int64_t photons_emitted) {
  const double path = mean_by(scene, "path", 512), bdpt = mean_by(scene, "bdpt", 256);
  const double ptracer = mean_by(scene, "ptracer", 1024);
  const double photons = photons_at_radius_zero(scene, radius, photons_emitted);
  std::printf("%.5g, of it path %.4f, bdpt %.4f, ptracer %.4f, photonmapper %.4f\n", expected, path / expected,
              bdpt / expected, ptracer / expected, photons / expected);
  EXPECT_NEAR(path / expected, 1, 0.005);
  EXPECT_NEAR(bdpt / expected, 1, 0.01);
  EXPECT_NEAR(ptracer / expected, 1, 0.025);
  EXPECT_NEAR(photons / expected, 1, 0.01);
}

class LeaningNormals : public testing::TestWithParam<int> {};

TEST_P(LeaningNormals, the_light_they_reflect_is_the_closed_form) {
  // The floor's radiance is albedo E cos a / pi in all directions; the wall receives the view factor's share of it.
  // Standard errors: 0.3 % of the photons' mean, 0.6 % of the light tracer's.
  const double degrees = GetParam(), a = degrees * std::numbers::pi / 180;
  const double expected = wall_albedo * view_factor * floor_albedo * irradiance * std::cos(a) / std::numbers::pi;
  const SceneDescription scene = wall_by_floor(degrees);
  expect_mean(scene, expected, 0.05, 2'000'000);
}

TEST_P(LeaningNormals, the_light_they_gather_is_the_closed_form) {
  // The wall's radiance is albedo E / pi; the floor gathers the share that its shading normal sees.
  const double degrees = GetParam(), a = degrees * std::numbers::pi / 180;
  const double expected =
      floor_albedo * (view_factor * std::cos(a) + sideways * std::sin(a)) * wall_albedo * irradiance / std::numbers::pi;
  const SceneDescription scene = floor_by_wall(degrees);
  expect_mean(scene, expected, 0.02, 1'000'000);  // gathers lose light at a mesh's edges
}

INSTANTIATE_TEST_SUITE_P(degrees, LeaningNormals, testing::Values(0, 20, 45, 60));

/// A map of 8 x 8 different normals that tilt by up to 75 degrees.
BitmapDescription rough_normals() {
  auto image = std::make_shared<Image>(8, 8);
  for (int i = 0; i < 64; ++i) {
    test::Random random(5, static_cast<std::uint64_t>(i));
    const double lean = 1.3 * std::sqrt(double{random.next()}), turn = 2 * std::numbers::pi * double{random.next()};
    const Vec3d n(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), std::cos(lean));
    float* pixel = image->pixel(i % 8, i / 8);
    pixel[0] = static_cast<float>(0.5 * n.x + 0.5);
    pixel[1] = static_cast<float>(0.5 * n.y + 0.5);
    pixel[2] = static_cast<float>(0.5 * n.z + 0.5);
  }
  return {"", image, true, TextureFilter::nearest, TextureWrap::repeat, {}};
}

class MappedFloor : public testing::TestWithParam<MappedNormalsDescription> {};

TEST_P(MappedFloor, is_the_same_to_all_integrators) {
  // The floor lights the wall. The floor is also lit, by the light at a slant and by the wall, and seen at a slant,
  // where many normals are turned away. Mirroring them is 20 % of the light, shadowing 9 %. Standard errors are 0.2 %
  // of bdpt's mean, 0.3 % of the photons' and 0.6 % of the light tracer's.
  SceneDescription scenes[] = {wall_by_floor(0), squares(0, normalize(Vec3d(1, 0, -0.3)),
                                                         Transform::look_at({-2.5, 0.2, 1}, {0.5, 0.5, 0}, {0, 0, 1}))};
  for (SceneDescription& scene : scenes) {
    scene.textures.push_back({{}, "", rough_normals()});
    const BsdfIndex grey = scene.shapes[0].bsdf;
    scene.shapes[0].bsdf = test::add_bsdf(scene, NormalMapDescription{TextureIndex{0}, grey, GetParam()});
    const double path = mean_by(scene, "path", 512);
    const double bdpt = mean_by(scene, "bdpt", 256), ptracer = mean_by(scene, "ptracer", 1024);
    const double photons = photons_of_radius(scene, 0.02, 1'000'000);
    std::printf("path %.5g, of it bdpt %.4f, ptracer %.4f, photonmapper %.4f\n", path, bdpt / path, ptracer / path,
                photons / path);
    EXPECT_NEAR(bdpt / path, 1, 0.01);
    EXPECT_NEAR(ptracer / path, 1, 0.025);
    EXPECT_NEAR(photons / path, 1, 0.015);
  }
}

INSTANTIATE_TEST_SUITE_P(options, MappedFloor,
                         testing::Values(MappedNormalsDescription{false, false}, MappedNormalsDescription{true, false},
                                         MappedNormalsDescription{false, true}, MappedNormalsDescription{true, true}),
                         [](const auto& options) {
                           return std::string(options.param.flip_invalid_normals ? "flipped" : "unflipped") +
                                  (options.param.use_shadowing_function ? "_shadowed" : "_unshadowed");
                         });

TEST(leaning_normals, of_a_light_do_not_emit) {
  // The floor is the light. The wall's radiance is albedo times the view factor's share of the floor's, whichever way
  // the floor's shading normals tilt. Cosines to those normals would give 42 % more or 80 % less, with their side
  // partly dark.
  for (const double degrees : {-45.0, 45.0}) {
    SceneDescription scene = wall_by_floor(degrees);
    scene.emitters.clear();
    scene.shapes[0].radiance = RgbD(2);
    scene.integrator.method = PathDescription{2, 24, false};
    const double expected = wall_albedo * view_factor * 2;
    for (const char* integrator : {"path", "bdpt", "volpath", "direct"})  // by sampled points and rays that meet it
      EXPECT_NEAR(mean_by(scene, integrator, 256) / expected, 1, 0.01) << integrator << " at " << degrees;
    EXPECT_NEAR(mean_by(scene, "ptracer", 1024) / expected, 1, 0.02) << degrees;  // by photons
    DirectDescription by_hits;
    by_hits.emitter_samples = 0;
    scene.integrator.method = by_hits;
    EXPECT_NEAR(mean_by(scene, "direct", 512) / expected, 1, 0.01) << degrees;
  }
  // Photons go from the light to the wall and back to the floor. The camera also sees the light's own radiance of 1
  // everywhere; standard error 0.6 %.
  SceneDescription scene = floor_by_wall(45);
  scene.emitters.clear();
  scene.shapes[0].radiance = RgbD(1);
  const double photons = photons_at_radius_zero(scene, 0.02, 1'000'000) - 1;
  EXPECT_NEAR(photons / (mean_by(scene, "path", 512) - 1), 1, 0.02);
}

TEST(twosided_floor, keeps_the_photons_of_its_two_sides_apart) {
  // The wall below lights the floor's back; seen from the front the floor is black.
  SceneDescription scene = floor_by_wall(0);
  scene.shapes[0].bsdf = test::add_bsdf(scene, TwoSidedDescription{scene.shapes[0].bsdf, scene.shapes[0].bsdf});
  scene.shapes[1].to_world = Transform::translate({0, 0, -1}) * scene.shapes[1].to_world;
  EXPECT_EQ(photons_of_radius(scene, 0.05, 200'000), 0);
  scene.sensor.to_world =
      Transform::look_at({0.5, 0.5, -3}, {0.5, 0.5, 0}, {0, 1, 0}) * Transform::scale({0.5, 0.5, 1});
  EXPECT_GT(photons_of_radius(scene, 0.05, 200'000), 0.05);
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
