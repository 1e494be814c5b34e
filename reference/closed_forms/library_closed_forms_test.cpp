// The means stated in expect.toml files, computed from the closed forms and the parsed scenes. A changed scene or
// formula fails here.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "reference/closed_forms/closed_forms.h"
#include "scenes/description/expect.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_closed_forms {
namespace {

using std::numbers::pi;

const std::string kLibrary = std::string(PHOTONPROOF_SOURCE_DIR) + "/scenes/library/";
constexpr Vec3d kUp{0, 1, 0};

SceneDescription load(const std::string& name) { return parse_scene_file(kLibrary + name + "/scene.xml"); }

/// Compares the mean in the scene's file with the formula's; the file's numbers have seven digits.
void expect_stated_mean(const std::string& name, const RgbD& mean) {
  const Expect expect = read_expect(kLibrary + name + "/expect.toml");
  ASSERT_TRUE(expect.analytic && expect.analytic->mean) << name;
  const RgbD stated = *expect.analytic->mean;
  EXPECT_NEAR(stated.x, mean.x, 2e-6 * mean.x) << name;
  EXPECT_NEAR(stated.y, mean.y, 2e-6 * mean.y) << name;
  EXPECT_NEAR(stated.z, mean.z, 2e-6 * mean.z) << name;
}

struct Ray {
  Vec3d origin, direction;
};

/// The ray through a point of the square image plane, u and v from -1 to 1.
Ray camera_ray(const SceneDescription& scene, double u, double v) {
  const auto& camera = std::get<PerspectiveDescription>(scene.sensor.camera);
  const double half = std::tan(camera.fov_degrees / 2 * pi / 180);
  return {scene.sensor.to_world.point({0, 0, 0}), scene.sensor.to_world.vector({half * u, half * v, 1})};
}

/// The mean over the image plane by the midpoint rule on n x n points: its error falls as the square of the step.
template <class Radiance>
/// With `sheared`, columns are shifted against each other: otherwise an edge along the rows would be in or out for all
/// of them at once.
RgbD mean_over_image(const SceneDescription& scene, const Radiance& radiance, int n = 512, bool sheared = false) {
  RgbD sum{0.0};
  for (int i = 0; i < n; ++i) {
    const double golden = 0.6180339887498949 * i, shift = sheared ? golden - std::floor(golden) : 0.5;
    for (int j = 0; j < n; ++j)
      sum += RgbD(radiance(camera_ray(scene, 2 * (i + 0.5) / n - 1, 2 * (j + shift) / n - 1)));
  }
  return sum / (double{static_cast<double>(n)} * n);
}

/// Mean image of a plane y = 0 of albedo 0.5 that fills the view and has the irradiance E.
RgbD mean_of_plane(const SceneDescription& scene, const std::function<double(const SurfacePoint&)>& irradiance,
                   int n = 512) {
  return mean_over_image(
      scene,
      [&](const Ray& ray) {
        const double t = -ray.origin.y / ray.direction.y;
        EXPECT_GT(t, 0) << "the plane must fill the view";
        return 0.5 / pi * irradiance({ray.origin + ray.direction * t, kUp});
      },
      n);
}

const ShapeDescription& light_of(const SceneDescription& scene) {
  return *std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const auto& s) { return s.radiance.has_value(); });
}
double radiance_of(const ShapeDescription& shape) { return constant(*shape.radiance).x; }

TEST(library_mean, of_light_sphere) {
  const auto scene = load("light-sphere");
  const ShapeDescription& area_light = light_of(scene);
  const auto& sphere = std::get<SphereDescription>(area_light.geometry);
  expect_stated_mean("light-sphere", mean_of_plane(scene, [&](const SurfacePoint& at) {
                       return irradiance_of_sphere(radiance_of(area_light), sphere.center, sphere.radius, at);
                     }));
}

TEST(library_mean, of_light_disk) {
  const auto scene = load("light-disk");
  const ShapeDescription& area_light = light_of(scene);
  const Vec3d middle = area_light.to_world.point({0, 0, 0});
  const double radius = length(area_light.to_world.vector({1, 0, 0}));
  EXPECT_LT(area_light.to_world.vector({0, 0, 1}).y, 0) << "faces down";
  expect_stated_mean("light-disk", mean_of_plane(scene, [&](const SurfacePoint& at) {
                       const Vec3d off = middle - at.position;
                       return irradiance_of_parallel_disc(radiance_of(area_light), radius, off.y,
                                                          std::hypot(off.x, off.z));
                     }));
}

TEST(library_mean, of_light_cylinder) {
  const auto scene = load("light-cylinder");
  const ShapeDescription& area_light = light_of(scene);
  const auto& tube = std::get<CylinderDescription>(area_light.geometry);
  const auto irradiance = [&](const SurfacePoint& at) {
    return irradiance_of_cylinder(radiance_of(area_light), tube.p0, tube.p1, tube.radius, at);
  };
  expect_stated_mean("light-cylinder", mean_of_plane(scene, irradiance));
}

TEST(library_mean, of_light_mesh) {
  const auto scene = load("light-mesh");
  const ShapeDescription& area_light = light_of(scene);
  const TriangleMesh& mesh = *std::get<MeshDescription>(area_light.geometry).mesh;
  expect_stated_mean("light-mesh", mean_of_plane(scene, [&](const SurfacePoint& at) {
                       double sum = 0;
                       for (const auto& t : mesh.triangles) {
                         const std::array<Vec3d, 3> corners{Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]),
                                                            Vec3d(mesh.positions[t[2]])};
                         sum += irradiance_of_polygon(radiance_of(area_light), corners, at);
                       }
                       return sum;
                     }));
}

TEST(library_mean, of_light_spot) {
  const auto scene = load("light-spot");
  const auto& spot = std::get<SpotLightDescription>(scene.emitters.at(0).light);
  const SpotCone cone{spot.beam_degrees * pi / 180, spot.cutoff_degrees * pi / 180};
  // Kinks at both circles: 2048 points leave 1e-6.
  expect_stated_mean("light-spot", mean_of_plane(
                                       scene,
                                       [&](const SurfacePoint& at) {
                                         return irradiance_of_spot(spot.intensity.x, spot.to_world.point({0, 0, 0}),
                                                                   spot.to_world.vector({0, 0, 1}), cone, at);
                                       },
                                       2048));
}

TEST(library_mean, of_light_directional_and_constant) {
  const auto scene = load("light-directional");
  const auto& beam = std::get<DirectionalLightDescription>(scene.emitters.at(0).light);
  expect_stated_mean("light-directional", beam.irradiance * (0.5 / pi * irradiance_of_beam(1, beam.direction, kUp)));
  const auto sky = load("light-constant");
  expect_stated_mean("light-constant", std::get<ConstantLightDescription>(sky.emitters.at(0).light).radiance *
                                           (0.5 / pi * irradiance_of_uniform_sky(1)));
}

TEST(library_mean, of_light_envmap) {
  const auto scene = load("light-envmap");
  const auto& sky = std::get<EnvmapDescription>(scene.emitters.at(0).light);
  // Mitsuba's lookup: the first row is the zenith, the last the nadir, linear between. E = 2 pi int L cos sin dt, L
  // the mean along the horizon, by the midpoint rule.
  const Image& image = *sky.image;
  const auto row_mean = [&](int y) {
    RgbD sum{0.0};
    for (int x = 0; x < image.width; ++x) {
      const float* c = image.pixel(x, y);
      sum += RgbD{double{c[0]}, double{c[1]}, double{c[2]}};
    }
    return sum / static_cast<double>(image.width);
  };
  constexpr int steps = 20'000;
  RgbD E{0.0};
  for (int i = 0; i < steps; ++i) {
    const double t = pi / 2 * (i + 0.5) / steps, at = t / pi * (image.height - 1), part = at - std::floor(at);
    const int y = static_cast<int>(at);
    E += (row_mean(y) * (1 - part) + row_mean(y + 1) * part) * (2 * pi * std::cos(t) * std::sin(t) * pi / 2 / steps);
  }
  expect_stated_mean("light-envmap", E * (sky.scale * 0.5 / pi));
}

TEST(library_mean, of_light_ies) {
  const auto scene = load("light-ies");
  const auto& area_light = std::get<IesLightDescription>(scene.emitters.at(0).light);
  const IesProfile& profile = *area_light.profile;
  ASSERT_EQ(profile.horizontal_degrees.size(), 1u);
  const auto candela = [&](double degrees) {
    const double step = 5;
    const auto i = static_cast<std::size_t>(degrees / step);
    const double part = degrees / step - static_cast<double>(i);
    return profile.candela[i] * (1 - part) + profile.candela[i + 1] * part;
  };
  EXPECT_NEAR(candela(60), 250, 1e-9) << "1000 cos^2";
  const Vec3d at_light = area_light.to_world.point({0, 0, 0}), nadir = area_light.to_world.vector({0, 0, -1});
  EXPECT_NEAR(nadir.y, -1, 1e-12);
  expect_stated_mean("light-ies", mean_of_plane(scene, [&](const SurfacePoint& at) {
                       const double angle = std::acos(dot(normalize(at.position - at_light), nadir)) * 180 / pi;
                       return irradiance_of_point(area_light.intensity.x * candela(angle), at_light, at);
                     }));
}

/// The nearest positive distance along the ray to a ball, or nothing.
std::optional<double> meet_ball(const Ray& ray, const Vec3d& center, double radius) {
  const Vec3d o = ray.origin - center;
  const double a = length_squared(ray.direction), b = dot(o, ray.direction), c = length_squared(o) - radius * radius;
  const double root = b * b - a * c;
  if (root < 0) return std::nullopt;
  const double near = (-b - std::sqrt(root)) / a, far = (-b + std::sqrt(root)) / a;
  if (near > 0) return near;
  return far > 0 ? std::optional(far) : std::nullopt;
}

double albedo_of(const SceneDescription& scene, const ShapeDescription& shape) {
  return constant(std::get<DiffuseDescription>(scene.bsdfs.at(shape.bsdf.value).model).reflectance).x;
}

TEST(library_mean, of_integrating_sphere) {
  const auto scene = load("integrating-sphere");
  const auto& light = std::get<PointLightDescription>(scene.emitters.at(0).light);
  const double albedo = albedo_of(scene, scene.shapes.at(0));
  const double indirect = integrating_sphere_indirect(4 * pi * light.intensity.x, albedo, 1);
  expect_stated_mean(
      "integrating-sphere", mean_over_image(scene, [&](const Ray& ray) {
        const Vec3d p = ray.origin + ray.direction * *meet_ball(ray, {0, 0, 0}, 1);
        return albedo / pi * (irradiance_of_point(light.intensity.x, light.position, {p, -p}) + indirect);
      }));
}

TEST(library_mean, of_concentric_spheres) {
  const auto scene = load("concentric-spheres");
  const ShapeDescription &inner = scene.shapes.at(0), &outer = scene.shapes.at(1);
  const double radius = std::get<SphereDescription>(inner.geometry).radius;
  // In units of radiance: exitance over pi.
  const RadiosityPair L =
      concentric_sphere_radiosity({radiance_of(inner), albedo_of(scene, inner)},
                                  {radiance_of(outer), albedo_of(scene, outer)}, concentric_sphere_factors(radius, 1));
  // The part of the image inside an outline: 4096 points a side leave 1e-6.
  expect_stated_mean("concentric-spheres", mean_over_image(
                                               scene,
                                               [&](const Ray& ray) {
                                                 return meet_ball(ray, {0, 0, 0}, radius) ? L.first : L.second;
                                               },
                                               4096));
}

TEST(library_mean, of_parallel_planes) {
  const auto scene = load("parallel-planes");
  const ShapeDescription &lower = scene.shapes.at(0), &upper = scene.shapes.at(1);
  const RadiosityPair L = parallel_plane_radiosity({radiance_of(lower), albedo_of(scene, lower)},
                                                   {radiance_of(upper), albedo_of(scene, upper)});
  expect_stated_mean("parallel-planes",
                     mean_over_image(
                         scene, [&](const Ray& ray) { return ray.direction.y < 0 ? L.first : L.second; }, 4096));
}

/// Mean image of a radiance that depends only on a ray's angle from z.
template <class OfAngle>
RgbD mean_over_angles(const SceneDescription& scene, const OfAngle& radiance) {
  return mean_over_image(scene, [&](const Ray& ray) { return radiance(std::acos(normalize(ray.direction).z)); });
}

TEST(library_mean, of_glass_slab) {
  const auto scene = load("glass-slab");
  expect_stated_mean("glass-slab", mean_over_angles(scene, [](double angle) {
                       return slab_transmittance(fresnel_reflectance(angle, 1.5).unpolarised());
                     }));
}

TEST(library_mean, of_absorption) {
  const auto scene = load("absorption");
  const auto& ink = std::get<HomogeneousDescription>(scene.media.at(0).model);
  const RgbD sigma_t = ink.sigma_t * ink.scale;
  expect_stated_mean(
      "absorption", mean_over_angles(scene, [&](double angle) {
        const double d = 1 / std::cos(angle);
        return RgbD{transmittance(sigma_t.x, d), transmittance(sigma_t.y, d), transmittance(sigma_t.z, d)};
      }));
}

/// Share of the image plane that a unit area at the point p of the plane y = 0 covers; 0 outside the view. A camera at
/// c that looks along the unit w sees p, at the depth z = (p - c) w, at (p - c) / z. An area dA at p covers
/// dA cos / (|p-c|^2) cos^-3 of the image plane, which is 2 tan(fov/2) wide. Flux that lands at p adds albedo / pi
/// times this share to the image's mean.
double part_of_image(const SceneDescription& scene, const Vec3d& p) {
  const auto& camera = std::get<PerspectiveDescription>(scene.sensor.camera);
  const double half = std::tan(camera.fov_degrees / 2 * pi / 180);
  const Vec3d seen = scene.sensor.to_world.inverse()->point(p);
  if (seen.z <= 0 || std::abs(seen.x) > half * seen.z || std::abs(seen.y) > half * seen.z) return 0;
  const Vec3d to_camera = scene.sensor.to_world.point({0, 0, 0}) - p;
  const double d = length(to_camera), cos_image = seen.z / d;
  return to_camera.y / d / (d * d) / std::pow(cos_image, 3) / (4 * half * half);
}

TEST(library_mean, of_ball_lens) {
  const auto scene = load("ball-lens");
  const auto& ball = std::get<SphereDescription>(scene.shapes.at(1).geometry);
  const BallLens lens{ball.radius, 1.5, ball.center.y};
  const double half = length(scene.shapes.at(0).to_world.vector({1, 0, 0}));
  const auto on_screen = [&](const Vec3d& p) { return std::abs(p.x) <= half && std::abs(p.z) <= half; };
  // Through the ball: rings of the beam, each ray's flux where it lands.
  constexpr int rings = 4001, around = 1201;
  double mean = 0;
  for (int i = 0; i < rings; ++i) {
    const double h = lens.radius * (i + 0.5) / rings;
    const BallRay ray = trace_ball(lens, h, 1);
    if (!ray.lands) continue;
    const double flux = ray.part * 2 * pi * h * lens.radius / rings / around;
    for (int j = 0; j < around; ++j) {
      const double phi = 2 * pi * (j + 0.5) / around;
      const Vec3d p{ray.landing * std::cos(phi), 0, ray.landing * std::sin(phi)};
      if (on_screen(p)) mean += 0.5 / pi * flux * part_of_image(scene, p);
    }
  }
  // And past it.
  mean += mean_over_image(
              scene,
              [&](const Ray& ray) {
                if (ray.direction.y >= 0) return 0.0;
                const Vec3d p = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
                return on_screen(p) && std::hypot(p.x, p.z) > lens.radius ? 0.5 / pi : 0.0;
              },
              4096, true)
              .x;
  const double stated = read_expect(kLibrary + "ball-lens/expect.toml").analytic->mean->x;
  EXPECT_NEAR(stated, mean, 1e-4 * mean) << "rays at the image's border are in or out";
  const Vec3d eye = scene.sensor.to_world.point({0, 0, 0});
  EXPECT_LT(eye.y, ball.center.y - ball.radius) << "the camera looks under the ball";
}

TEST(library_mean, of_water_caustic) {
  const auto scene = load("water-caustic");
  const SinusoidalWater water{0.03, 0.5, 1, 1.33};
  // The beam's rays as above: rows across the waves, columns along them.
  constexpr int across = 40001, along = 601;
  double mean = 0;
  for (int i = 0; i < across; ++i) {
    const WaterRay ray = trace_water(water, -1.5 + 3 * (i + 0.5) / across);
    for (int j = 0; j < along; ++j) {
      const double golden = 0.6180339887498949 * i, shift = golden - std::floor(golden);
      const Vec3d p{ray.landing, 0, -1.5 + 3 * (j + shift) / along};
      mean += 0.5 / pi * ray.transmittance * 9 / (double{across} * along) * part_of_image(scene, p);
    }
  }
  const double stated = read_expect(kLibrary + "water-caustic/expect.toml").analytic->mean->x;
  EXPECT_NEAR(stated, mean, 1e-4 * mean) << "rays at the image's border are in or out";
}

}  // namespace
}  // namespace photonproof::inline reference_closed_forms
