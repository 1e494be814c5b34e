// Lights of all kinds that are a thousandth to a hundred thousand times as large as their distance. Each estimate must
// stay within its own error, and that error must be small. An estimator that rarely samples the near part of a light
// fails here, since its error estimate is far too small.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/light_sampling/test_lights.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

constexpr double half_turn = std::numbers::pi;

/// Irradiance share of a square of half-size s, parallel at distance 1 over its middle: four times that of the parallel
/// rectangle at its corner.
double share_of_square(double s) {
  const double a = s / std::hypot(1, s);
  return 4 * a * std::atan(a) / half_turn;
}
/// Coaxial disk: s^2/(1 + s^2). Sphere at gap 1: (s/(1 + s))^2. Cylinder of practically infinite length: s/(1 + s).
double share_of_disk(double s) { return s * s / (1 + s * s); }
double share_of_sphere(double s) { return s * s / ((1 + s) * (1 + s)); }
double share_of_cylinder(double s) { return s / (1 + s); }

struct TestLight {
  std::string name;
  std::function<Light(float s)> light;
  double (*share)(double s);  ///< irradiance / (pi L) at a point of the plane y = 0 that faces up
  Vec3d nearest{0, 1, 0};     ///< nearest point of the light to that
};

LightShape mesh_square(float s, int cells) {
  std::vector<Vec3f> positions;
  std::vector<MeshShape::Triangle> faces;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      positions.emplace_back(s * (2 * static_cast<float>(i) / static_cast<float>(cells) - 1), 1.0f,
                             s * (2 * static_cast<float>(j) / static_cast<float>(cells) - 1));
  const auto row = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t j = 0; j + 1 < row; ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      faces.push_back({a, b, d});
      faces.push_back({a, d, c});
    }
  return MeshShape(positions, faces, {}, false);
}

/// Nearest point of an inward light. It is slanted, since points along the axes avoid most roundings.
const Vec3d slanted{-0.6, 0.8, 0};

/// A sphere that shines outward above y = 1, or inward around the space below `slanted`. Large ones use their offset.
SphereShape ball(float s, float sign) {
  SphereShape shape{sign > 0 ? Vec3f(0, 1 + s, 0) : Vec3f(slanted * (1 - double{s})), s};
  shape.sign = sign;
  if (s > 4096) shape.offset = sign * (1 + 0.5f / s);
  return shape;
}
Light ball_light(float s, float sign) {
  const SphereShape shape = ball(s, sign);
  return SphereLight<float>{shape.center, shape.radius, sign, Rgb(1), shape.offset};
}
CylinderShape tube(double s, double sign) {
  const double length = 4000 * (1 + s);
  const Vec3d towards = sign > 0 ? Vec3d(0, 1, 0) : slanted, along = cross(towards, {0, 0, 1});
  return {towards * (1 + sign * s) - along * (length / 2),
          along * length,
          Vec3f(towards),
          {0, 0, 1},
          s,
          static_cast<float>(sign)};
}
Light textured(const LightShape& shape) {
  return AreaLight(shape, [](const Vec2<float>&) { return Rgb(1); });
}

std::vector<TestLight> area_lights() {
  const auto quad = [](float s) { return QuadShape{{-s, 1, -s}, {2 * s, 0, 0}, {0, 0, 2 * s}, {0, -1, 0}}; };
  const auto disk = [](float s) { return DiskShape{{0, 1, 0}, {s, 0, 0}, {0, 0, s}, {0, -1, 0}}; };
  return {
      {"quad",
       [=](float s) {
         return QuadLight<float>{{-s, 1, -s}, {2 * s, 0, 0}, {0, 0, 2 * s}, {0, -1, 0},
                                 4 * s * s,   Rgb(1),        told_by_corner};
       },
       share_of_square},
      {"textured quad", [=](float s) { return textured(quad(s)); }, share_of_square},
      {"disk",
       [=](float s) {
         return DiskLight<float>{{0, 1, 0}, {s, 0, 0}, {0, 0, s}, {0, -1, 0}, pi * s * s, Rgb(1), told_by_corner};
       },
       share_of_disk},
      {"textured disk", [=](float s) { return textured(disk(s)); }, share_of_disk},
      {"sphere", [](float s) { return ball_light(s, 1); }, share_of_sphere},
      {"textured sphere", [](float s) { return textured(ball(s, 1)); }, share_of_sphere},
      {"cylinder", [](float s) { return AreaLight(LightShape(tube(s, 1)), Rgb(1)); }, share_of_cylinder},
      {"mesh of 2", [](float s) { return AreaLight(mesh_square(s, 1), Rgb(1)); }, share_of_square},
      {"mesh of 800", [](float s) { return AreaLight(mesh_square(s, 20), Rgb(1)); }, share_of_square},
  };
}

/// Lights without an upper limit of size.
std::vector<TestLight> round_lights() {
  const auto all = [](double) { return 1.0; };
  return {{"sphere", [](float s) { return ball_light(s, 1); }, share_of_sphere},
          {"inward sphere", [](float s) { return ball_light(s, -1); }, all, slanted},
          {"textured sphere", [](float s) { return textured(ball(s, 1)); }, share_of_sphere},
          {"cylinder", [](float s) { return AreaLight(LightShape(tube(s, 1)), Rgb(1)); }, share_of_cylinder},
          {"inward cylinder", [](float s) { return AreaLight(LightShape(tube(s, -1)), Rgb(1)); }, all, slanted}};
}

struct Estimate {
  double mean = 0, error = 0;
};

/// Irradiance / (pi L) by next-event estimation alone.
Estimate irradiance(const Light& light, std::uint64_t seed, int samples) {
  const test::Lights lights({light});
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    const LightSeen c = lights.scene.sample({0, 0, 0}, 0.5f, test::Random(seed, static_cast<std::uint64_t>(i)).next2());
    const double x = c.pdf > 0 ? double{c.radiance.x} * std::max(0.0, double{c.wi.y}) / double{c.pdf} / half_turn : 0;
    sum += x;
    squares += x * x;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt(std::max(squares / samples - mean * mean, 0.0) / samples)};
}

/// Largest relative difference between a sample's density and that of its point.
double worst_density(const Light& light, std::uint64_t seed) {
  const test::Lights lights({light});
  double worst = 0;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const LightSeen c = lights.scene.sample({0.3f, 0, 0}, 0.5f, test::Random(seed, i).next2());
    if (c.pdf > 0)
      worst = std::max(worst, std::abs(double{lights.scene.pdf(c.light, {0.3f, 0, 0}, c.at)} / double{c.pdf} - 1));
  }
  return worst;
}

TEST(close_lights, irradiance_keeps_to_its_error_from_a_thousandth_to_a_hundred_thousand_times_the_distance) {
  // The worst relative spread of 100,000 samples, that of the mesh of 800, is 2.8: the test detects an error of 4 %
  // anywhere.
  std::uint64_t seed = 7100;
  for (const TestLight& area_light : area_lights())
    for (int decade = -3; decade <= 5; ++decade) {
      const double s = std::pow(10, decade), truth = area_light.share(double{static_cast<float>(s)});
      const Estimate e = irradiance(area_light.light(static_cast<float>(s)), ++seed, 100'000);
      EXPECT_NEAR(e.mean, truth, 4 * e.error + 2e-5 * truth) << area_light.name << " of " << s;
      EXPECT_LT(e.error, 0.01 * truth) << area_light.name << " of " << s;
    }
}

TEST(close_lights, irradiance_of_round_ones_keeps_to_its_error_up_to_a_million_million_times_the_distance) {
  std::uint64_t seed = 7500;
  for (const TestLight& area_light : round_lights())
    for (int decade = 4; decade <= 12; ++decade) {
      const auto s = static_cast<float>(std::pow(10, decade));
      const Estimate e = irradiance(area_light.light(s), ++seed, 60'000);
      EXPECT_NEAR(e.mean, area_light.share(double{s}), 4 * e.error + 2e-5) << area_light.name << " of " << s;
      EXPECT_LT(e.error, 0.01) << area_light.name << " of " << s;
      EXPECT_LT(worst_density(area_light.light(s), ++seed), 1e-3) << area_light.name << " of " << s;
    }
}

TEST(close_lights, a_sphere_that_all_but_touches_fills_the_hemisphere) {
  // Gaps down to a millionth of the radius, straight below: E = pi L (R/d)^2. Only a share gap/R of area samples helps.
  for (const double gap : {1e-3, 1e-4, 5e-5, 1e-5, 1e-6}) {
    const auto d = static_cast<float>(1 + gap);
    const Estimate e = irradiance(SphereLight<float>{{0, d, 0}, 1, 1, Rgb(1)}, 7200, 60'000);
    EXPECT_NEAR(e.mean, 1 / (double{d} * double{d}), 4 * e.error + 1e-4) << gap;
    EXPECT_LT(e.error, 0.01) << gap;
  }
}

// --- photons ---------------------------------------------------------------------------------------------------------

// Flux from within a distance r of the light's nearest point. In each half of the cosine lobe (sin^2 below or above
// 1/2) and each half of the azimuth it is pi L A / 4. For a flat light A = pi r^2. For a sphere, the cap of that chord
// around the point nearest to p has the same area, and so large a tube is flat. A wrong density would make a part
// brighter or darker. The test detects 20 %, for the nearest parts 5 %.
void expect_flux_of_every_part(const TestLight& area_light, float s) {
  constexpr int samples = 150'000;
  const std::vector<ProjectionTarget> seen{{{0, 0, 0}, 0.5f}, {{3, 0, 1}, 2}};
  test::Lights lights({area_light.light(s)});
  lights.scene.guide_emission(EmissionGuiding(lights.lights, seen, {}));
  ASSERT_TRUE(lights.scene.has_guide());
  constexpr std::array<double, 3> reach{1, 4, 16};
  std::array<double, 12> sum{}, squares{};
  for (int i = 0; i < samples; ++i) {
    test::Random r(7300, static_cast<std::uint64_t>(i));
    const Vec2<float> u_position = r.next2();
    const LightStart e = lights.scene.emit(0.5f, u_position, r.next2());
    if (!(e.flux.x > 0)) continue;
    const double from = length(Vec3d(e.at.p) - area_light.nearest), cosine = dot(e.at.normal, e.direction);
    const std::size_t bin = (cosine * cosine > 0.5 ? 2 : 0) + (e.direction.z > 0 ? 1 : 0);
    for (std::size_t k = 0; k < reach.size(); ++k)
      if (from < reach[k]) {
        sum[4 * k + bin] += double{e.flux.x};
        squares[4 * k + bin] += double{e.flux.x} * double{e.flux.x};
      }
  }
  for (std::size_t k = 0; k < reach.size(); ++k)
    for (std::size_t bin = 0; bin < 4; ++bin) {
      const double mean = sum[4 * k + bin] / samples;
      const double error = std::sqrt((squares[4 * k + bin] / samples - mean * mean) / samples);
      const double expected = half_turn * half_turn * reach[k] * reach[k] / 4;
      EXPECT_NEAR(mean, expected, 4.5 * error)
          << area_light.name << " of " << s << ", within " << reach[k] << ", " << bin;
      EXPECT_LT(error, 0.08 * expected) << area_light.name << " of " << s << ", within " << reach[k] << ", " << bin;
    }
}

TEST(close_lights, guided_photons_carry_what_every_part_of_the_light_emits_in_every_direction) {
  for (const TestLight& area_light : area_lights()) expect_flux_of_every_part(area_light, 1e4f);
  for (const TestLight& area_light : round_lights())
    for (const float s : {1e7f, 1e9f}) expect_flux_of_every_part(area_light, s);
}

TEST(close_lights, guided_photons_of_a_long_tube_carry_what_it_emits) {
  // Within z of the middle the side of a cylinder has the area 2 pi R 2z. For the outward cylinder the test counts the
  // sixth whose normals are within 30 degrees of straight down, which p sees.
  for (const float sign : {1.0f, -1.0f}) {
    test::Lights lights(
        {AreaLight(LightShape(CylinderShape{{-1e4f, 3, 0}, {2e4f, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2, sign}), Rgb(1))});
    lights.scene.guide_emission(EmissionGuiding(lights.lights, {{{0, sign > 0 ? 0.0f : 2.0f, 0}, 0.5f}}, {}));
    ASSERT_TRUE(lights.scene.has_guide());
    for (const double z : {1.0, 10.0}) {
      constexpr int samples = 100'000;
      double sum = 0, squares = 0;
      for (int i = 0; i < samples; ++i) {
        test::Random r(7400, static_cast<std::uint64_t>(i));
        const Vec2<float> u_position = r.next2();
        const LightStart e = lights.scene.emit(0.5f, u_position, r.next2());
        if (std::abs(double{e.at.p.x}) > z || (sign > 0 && e.at.normal.y > -0.8660254f)) continue;
        sum += double{e.flux.x};
        squares += double{e.flux.x} * double{e.flux.x};
      }
      const double mean = sum / samples, error = std::sqrt((squares / samples - mean * mean) / samples);
      const double expected = half_turn * 2 * half_turn * 2 * 2 * z / (sign > 0 ? 6 : 1);
      EXPECT_NEAR(mean, expected, 4.5 * error) << sign << ", " << z;
      EXPECT_LT(error, 0.08 * expected) << sign << ", " << z;
    }
  }
}

// --- whole renders ---------------------------------------------------------------------------------------------------

enum class Kind { quad, disk, sphere, cylinder, mesh };

/// A light of radiance 1 and half-size s, 5 above a square floor of albedo 0.5 and half-size `floor`. The camera is at
/// half that height; `seen` is the half-width of the visible floor.
SceneDescription floor_under_light(Kind kind, double s, double floor, double light_albedo, double seen) {
  SceneDescription scene;
  const BsdfIndex grey = test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)});
  const BsdfIndex of_light = test::add_bsdf(scene, DiffuseDescription{RgbD(light_albedo)});
  test::add_shape(scene, RectangleDescription{}, Transform::rotate({1, 0, 0}, -90) * Transform::scale(Vec3d(floor)),
                  grey);
  const Transform down = Transform::translate({0, 5, 0}) * Transform::rotate({1, 0, 0}, 90);
  ShapeDescription* area_light = nullptr;
  switch (kind) {
    case Kind::quad:
      area_light = &test::add_shape(scene, RectangleDescription{}, down * Transform::scale(Vec3d(s)), of_light);
      break;
    case Kind::disk:
      area_light = &test::add_shape(scene, DiskDescription{}, down * Transform::scale(Vec3d(s)), of_light);
      break;
    case Kind::sphere:
      area_light = &test::add_shape(scene, SphereDescription{{0, 5 + s, 0}, s}, {}, of_light);
      break;
    case Kind::cylinder:
      area_light = &test::add_shape(
          scene, CylinderDescription{{-100 * (5 + s), 5 + s, 0}, {100 * (5 + s), 5 + s, 0}, s}, {}, of_light);
      break;
    case Kind::mesh: {
      auto mesh = std::make_shared<TriangleMesh>();
      mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
      mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
      MeshDescription description;
      description.mesh = mesh;
      area_light = &test::add_shape(scene, description, down * Transform::scale(Vec3d(s)), of_light);
      break;
    }
  }
  area_light->radiance = RgbD(1);
  test::set_camera(scene, Transform::look_at({0, 2.5, 0}, {0, 0, 0}, {0, 0, 1}),
                   2 * std::atan(seen / 2.5) * 180 / half_turn, 8);
  scene.integrator.method = PathDescription{-1, 5, true};
  return scene;
}

/// Mean over the image. Its error follows from the image's variance as if all pixels shared it.
Estimate rendered(const SceneDescription& scene, const char* integrator, const RenderJob& job) {
  const auto out = test::render(scene, integrator, job);
  return {test::image_mean(out.image.mean), std::sqrt(test::image_mean(*out.image.variance))};
}

double share_of(Kind kind, double s) {
  switch (kind) {
    case Kind::disk:
      return share_of_disk(s / 5);
    case Kind::sphere:
      return share_of_sphere(s / 5);
    case Kind::cylinder:
      return share_of_cylinder(s / 5);
    default:
      return share_of_square(s / 5);
  }
}

TEST(close_lights, camera_paths_keep_to_their_error_under_any_light) {
  // 64 pixels of 256 samples: errors of a pixel are a few percent, of the mean below 1 %. From the middle to the edge
  // of the visible floor the irradiance falls by less than (0.05/5)^2.
  for (const Kind kind : {Kind::quad, Kind::disk, Kind::sphere, Kind::cylinder, Kind::mesh})
    for (const double s : {5e-3, 0.5, 5.0, 500.0, 1e4, 5e5}) {
      for (const char* integrator : {"photonmapper", "path", "bdpt"}) {
        const SceneDescription scene = floor_under_light(kind, s, 2, 0, 0.05);
        const double truth = 0.5 * share_of(kind, s);
        const Estimate e = rendered(scene, integrator, test::job_with(256, 10'000));
        SCOPED_TRACE(std::string(integrator) + ", kind " + std::to_string(static_cast<int>(kind)) + " of " +
                     std::to_string(s));
        EXPECT_NEAR(e.mean, truth, 4 * e.error / 8 + 2e-4 * truth);
        EXPECT_LT(e.error / 8, 0.01 * truth);
      }
    }
}

TEST(close_lights, light_paths_start_where_what_is_seen_gets_its_light_from) {
  // With evenly distributed starts, one path in 10^6 to 10^10 would arrive.
  for (const Kind kind : {Kind::quad, Kind::disk, Kind::sphere, Kind::cylinder, Kind::mesh})
    for (const double s : {500.0, 1e4, 5e5}) {
      const Estimate e = rendered(floor_under_light(kind, s, 2, 0, 1), "ptracer", test::job_with(1024));
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + " of " + std::to_string(s));
      const double truth = 0.5 * share_of(kind, s);
      EXPECT_NEAR(e.mean, truth, 4 * e.error / 8 + 2e-3 * truth);
      EXPECT_LT(e.error / 8, 0.02 * truth);
    }
}

TEST(close_lights, between_a_luminous_ceiling_and_a_floor_light_adds_up) {
  // Both look infinite to the camera: B = rho (L + rho_light B), so 0.5 / (1 - 0.25) = 2/3 of the light's radiance.
  for (const double s : {1e3, 1e5})
    for (const char* integrator : {"photonmapper", "path", "bdpt", "ptracer"}) {
      const SceneDescription scene = floor_under_light(Kind::quad, s, s, 0.5, 2);
      const Estimate e = rendered(scene, integrator, test::job_with(256, 400'000));
      SCOPED_TRACE(std::string(integrator) + " of " + std::to_string(s));
      EXPECT_NEAR(e.mean, 2.0 / 3, 4 * e.error / 8 + 0.01);
      EXPECT_LT(e.error / 8, integrator == std::string("ptracer") ? 0.1 : 0.02);
    }
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
