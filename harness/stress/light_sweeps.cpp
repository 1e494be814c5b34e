#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep_rows.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {
namespace {

using std::numbers::pi;

double power(double k) { return std::pow(10.0, k); }

const Vec3d above{1, 5, -1};
constexpr double intensity = 20;

/// The light faces straight down. A flat light's cosine makes it differ from a point light, so only balls are compared
/// with one. The others are compared with themselves at a thousandth of their distance in size.
Sweep tiny(const char* shape, const Geometry& geometry, double area, bool is_ball) {
  const auto area_light = [=](double k) {
    const double size = power(-k);
    return StressScene{stress_scene_under_shape(geometry, is_ball ? standing(above, size) : hanging(above, size),
                                                intensity / (area * size * size))};
  };
  Sweep sweep{"light " + std::string(shape), "tiny", "a size of 10^-k, the same power",
              {4, 6, 9, 12, 15, 19},         9,      area_light};
  if (is_ball)
    sweep.alike = [](double) { return StressScene{stress_scene_under(PointLightDescription{above, RgbD(intensity)})}; };
  else
    sweep.alike = [=](double) { return area_light(3); };
  return sweep;
}

const Vec3d towards{0.36, 0.8, -0.48};
constexpr double irradiance = 2;

/// A light at distance 10^k, a hundredth as large: its beam is that of an infinitely far light.
Sweep far(const char* shape, const Geometry& geometry, double area) {
  const auto area_light = [=](double k) {
    const double size = 0.003 * power(k);
    const Transform place =
        Transform::look_at(towards * power(k), {0, 0, 0}, {0, 1, 0}) * Transform::scale(Vec3d(size));
    return StressScene{stress_scene_under_shape(geometry, place, irradiance / (area * 0.003 * 0.003))};
  };
  return {"light " + std::string(shape),
          "far",
          "10^k away, irradiance as of a beam",
          {4, 6, 9, 12, 15, 19},
          9,
          area_light,
          [](double) {
            return StressScene{stress_scene_under(DirectionalLightDescription{towards * -1.0, RgbD(irradiance)})};
          }};
}

std::vector<Sweep> point_lights() {
  const auto far_point = [](double k) {
    return StressScene{stress_scene_under(PointLightDescription{towards * power(k), RgbD(irradiance * power(2 * k))})};
  };
  const auto beam = [](double) {
    return StressScene{stress_scene_under(DirectionalLightDescription{towards * -1.0, RgbD(irradiance)})};
  };
  const auto far_spot = [](double k) {
    SpotLightDescription spot;
    spot.to_world = Transform::look_at(towards * power(k), {0, 0, 0}, {0, 1, 0});
    spot.intensity = RgbD(irradiance * power(2 * k));
    spot.beam_degrees = 5;
    spot.cutoff_degrees = 10;
    return StressScene{stress_scene_under(spot)};
  };
  // The light is at the height 10^-k sin a; cosine over squared distance stays the same.
  const auto grazing = [](double k) {
    SceneDescription scene = stress_scene_floor();
    const double sine = power(-k);
    scene.emitters.push_back(
        {{}, "", DirectionalLightDescription{{std::sqrt(1 - sine * sine), -sine, 0}, RgbD(irradiance / sine)}});
    return StressScene{scene};
  };
  Sweep flat{"light directional",          "grazing", "at a sine of 10^-k above the floor",
             {1, 2, 3, 4, 5, 6, 7, 9, 12}, 6,         grazing};
  flat.radiance = irradiance * 0.5 / pi;
  // Off the axes, rounding of directions is 1e-7 of the sine. Its effect at 10^-3 is too small for a warning, but
  // engines without noise here would show it.
  Sweep tilted = turned(flat);
  std::erase(tilted.heights, 3);
  tilted.wanted = 2;
  tilted.quick = 6;
  return {{"light point", "far", "10^k away, irradiance as of a beam", {4, 6, 9, 12, 15, 18}, 9, far_point, beam},
          {"light spot", "far", "10^k away, irradiance as of a beam", {4, 6, 9, 12, 15, 18}, 9, far_spot, beam},
          flat,
          tilted};
}

const std::vector<std::string> with_light_paths{"path", "bdpt", "ptracer"};

/// The floor under a spot light 2 above it, seen as far as its light reaches: narrow and wide beams look the same.
StressScene beam_on_the_floor(double cutoff_degrees) {
  SceneDescription scene = stress_scene_floor();
  SpotLightDescription spot;
  spot.to_world = Transform::look_at({0, 2, 0}, {0, 0, 0}, {0, 0, 1});
  spot.beam_degrees = 0.5 * cutoff_degrees;
  spot.cutoff_degrees = cutoff_degrees;
  scene.emitters.push_back({{}, "", spot});
  // A second light faces away: with two lights, each is chosen by its flux, which must not be 0.
  spot.to_world = Transform::look_at({0, 2, 0}, {0, 4, 0}, {0, 0, 1});
  scene.emitters.push_back({{}, "", spot});
  scene.sensor.camera = OrthographicDescription{};
  scene.sensor.to_world =
      Transform::look_at({0, 3, 0}, {0, 0, 0}, {0, 0, -1}) *
      Transform::scale({2 * std::tan(cutoff_degrees * pi / 180), 2 * std::tan(cutoff_degrees * pi / 180), 1});
  return {scene};
}

std::vector<Sweep> angles_of_light() {
  Sweep narrow{"light spot",
               "narrow beam",
               "a cut-off angle of 10^-k degrees",
               {2, 3, 4, 6, 7, 8, 9, 12},
               9,
               [](double k) { return beam_on_the_floor(power(-k)); },
               [](double) { return beam_on_the_floor(0.1); }};
  Sweep wide{"light spot",
             "wide beam",
             "a beam and a cut-off angle of 90 - 10^-k degrees, as a point",
             {0, 1, 2, 3, 6, 9, 12},
             12,
             [](double k) {
               SpotLightDescription spot;
               spot.to_world = Transform::look_at(above, above - Vec3d{0, 1, 0}, {0, 0, 1});
               spot.intensity = RgbD(intensity);
               spot.beam_degrees = spot.cutoff_degrees = 90 - power(-k);
               return StressScene{stress_scene_under(spot)};
             },
             [](double) {
               return StressScene{stress_scene_under(PointLightDescription{above, RgbD(intensity)})};
             }};
  const auto sun = [](double degrees) {
    SunSkyDescription light;
    light.to_world = Transform::rotate({1, 0, 0}, -90);  // its z is up
    light.sun_direction = {towards.x, -towards.z, towards.y};
    light.sky_scale = 0;
    light.sun_aperture_degrees = degrees;
    return StressScene{stress_scene_under(light)};
  };
  Sweep small{"light sunsky",
              "small sun",
              "an aperture of 10^-k degrees",
              {2, 3, 4, 5, 6, 9, 12, 30},
              9,
              [=](double k) { return sun(power(-k)); },
              [=](double) { return sun(0.1); }};
  for (Sweep* sweep : {&narrow, &wide, &small}) sweep->engines = with_light_paths;
  // Off the axes, directions are accurate to 10^-7.
  Sweep tilted = turned(narrow);
  tilted.heights = {2, 3, 4, 5, 6};
  tilted.wanted = 4;
  tilted.quick = 6;
  return {narrow, tilted, wide, small};
}

/// A disk or square of half width 10^k above floor and camera: at 10^4 it covers the upper half of a sky up to 1e-6.
StressScene under_plate(const Geometry& geometry, double k) {
  return {stress_scene_under_shape(geometry, hanging({0, 12, 0}, power(k)), 1)};
}
Sweep huge_plate(const char* shape, const Geometry& geometry) {
  const auto area_light = [=](double k) { return under_plate(geometry, k); };
  return {"light " + std::string(shape),        "huge", "a half width of 10^k", {5, 6, 7, 9, 11, 13, 15}, 9, area_light,
          [=](double) { return area_light(4); }};
}

/// A ball of radius 10^k whose nearest point is 12 above the floor: at 10^7 it equals such a plate up to 1e-5. A sky
/// would light the ball on the floor from below the horizon, too.
Sweep huge_ball() {
  return {
      "light sphere",
      "huge",
      "a radius of 10^k",
      {7, 9, 11, 13, 15},
      9,
      [](double k) {
        return StressScene{stress_scene_under_shape(SphereDescription{}, standing({0, power(k) + 12, 0}, power(k)), 1)};
      },
      [](double) { return under_plate(DiskDescription{}, 4); }};
}

/// Only the floor's far side, 6 to 10 away from a light at x = -7.
SceneDescription floor_from_aside() {
  SceneDescription scene = stress_scene_floor();
  scene.sensor.to_world = Transform::look_at({0, 7, 5}, {0, 0, 0}, {0, 1, 0});
  std::get<PerspectiveDescription>(scene.sensor.camera).fov_degrees = 20;
  return scene;
}

constexpr double aside = -7;

/// A light 10^-k above the floor, of intensity I along it: at a distance r it gives I 10^-k / r^3.
std::vector<Sweep> near_the_floor() {
  const double along = 200;
  const auto place = [](double k) { return Vec3d{aside, power(-k), 0}; };
  const auto point = [=](double k) {
    SceneDescription scene = floor_from_aside();
    scene.emitters.push_back({{}, "", PointLightDescription{place(k), RgbD(along * power(k))}});
    return StressScene{scene};
  };
  const auto spot = [=](double k) {
    SceneDescription scene = floor_from_aside();
    SpotLightDescription light;
    light.to_world = Transform::look_at(place(k), place(k) + Vec3d{1, 0, 0}, {0, 1, 0});
    light.intensity = RgbD(along * power(k));
    light.beam_degrees = 60;
    light.cutoff_degrees = 80;
    scene.emitters.push_back({{}, "", light});
    return StressScene{scene};
  };
  // The light's size is a tenth of its height. It faces along the floor; area A and radiance L give the intensity A L.
  const auto shaped = [=](const Geometry& geometry, double area, bool is_ball) {
    return [=](double k) {
      SceneDescription scene = floor_from_aside();
      const double size = 0.1 * power(-k);
      const Transform facing = Transform::look_at(place(k), place(k) + Vec3d{1, 0, 0}, {0, 1, 0});
      const Transform to_world = is_ball ? standing(place(k), size) : facing * Transform::scale(Vec3d(size));
      add_shape(scene, geometry, to_world, add_bsdf(scene, DiffuseDescription{RgbD(0.0)})).radiance =
          RgbD(along * power(k) / (area * size * size));
      return StressScene{scene};
    };
  };
  std::vector<Sweep> sweeps;
  // A flat light's intensity falls to the sides, so it is compared with itself.
  const auto add = [&](const char* light, const std::function<StressScene(double)>& level,
                       const std::function<StressScene(double)>& other) {
    sweeps.push_back({"light " + std::string(light),
                      "near the floor",
                      "10^-k above it, and as much brighter",
                      {4, 5, 6, 7, 8, 9, 12},
                      9,
                      level,
                      [=](double) { return other(3); }});
    sweeps.back().engines = {"path", "photonmapper", "bdpt", "volpath"};
    // Off the axes, single precision limits a height at coordinates near 7.
    Sweep tilted = turned(sweeps.back());
    tilted.heights.insert(tilted.heights.begin(), 3);
    tilted.wanted = 3;
    tilted.quick = 5;
    sweeps.push_back(std::move(tilted));
  };
  const auto square = shaped(RectangleDescription{}, 4, false), disk = shaped(DiskDescription{}, pi, false);
  add("point", point, point);
  add("spot", spot, point);
  add("rectangle", square, square);
  add("disk", disk, disk);
  add("sphere", shaped(SphereDescription{}, pi, true), point);
  return sweeps;
}

/// Light that camera paths may lose: the bright spot beside a light, and a light that nearly lies in a surface.
std::vector<Sweep> lights_on_surfaces_of_rooms() {
  const auto in_a_ball = [](double k) {
    SceneDescription scene = closed_sphere(0, 0.5);
    scene.shapes[0].radiance.reset();
    scene.emitters.push_back({{}, "", PointLightDescription{Vec3d{0.48, -0.6, 0.64} * (1 - power(-k)), RgbD(1)}});
    return StressScene{scene};
  };
  Sweep spot{"light point", "near a wall", "10^-k from the wall of a ball", {0.5, 1, 2, 3, 4, 6, 9}, 1,
             in_a_ball,     in_a_ball};
  spot.compared_with = "bdpt";
  spot.engines = {"path", "photonmapper", "ptracer"};
  spot.quick = 4;
  const auto on_the_floor = [](double k) {
    SceneDescription scene = stress_scene_floor();
    const double height = k == 99 ? 0 : power(-k);
    add_shape(scene, RectangleDescription{}, lying({0.3, height, 0.2}, 1), add_bsdf(scene, DiffuseDescription{}))
        .radiance = RgbD(1);
    return StressScene{scene};
  };
  Sweep panel{"light rectangle",
              "on the floor",
              "10^-k above it; 99: in it",
              {4, 5, 6, 7, 8, 9, 12, 99},
              5,
              on_the_floor,
              [=](double) { return on_the_floor(4); }};
  panel.quick = 99;
  panel.engines = with_light_paths;
  return {spot, panel};
}

/// An environment whose file holds 10^k times the values, scaled by 10^-k.
std::vector<Sweep> bright_and_dim_files(const std::filesystem::path& assets) {
  SceneDescription base;
  for (const NamedScene& named : scenes_of_features(assets))
    if (named.first == "light envmap") base = named.second;
  const auto light_of = [](SceneDescription& scene) -> EnvmapDescription& {
    return std::get<EnvmapDescription>(scene.emitters[0].light);
  };
  const Image picture = read_image(light_of(base).filename);
  const auto file_of = [=](double k) {
    return std::filesystem::absolute(assets / fmt::format("picture{:+g}.exr", k)).string();
  };
  const auto sweep_run = [&](const char* name, const char* measure, double sign) {
    Sweep sweep{"light envmap",
                name,
                measure,
                {4, 9, 15, 20, 30, 37},
                30,
                [=](double k) {
                  SceneDescription scene = base;
                  light_of(scene).filename = file_of(sign * k);
                  light_of(scene).scale = power(-sign * k);
                  return StressScene{scene};
                },
                [=](double) { return StressScene{base}; }};
    for (const double k : sweep.heights) {
      Rendering other;
      other.mean = picture;
      for (float& v : other.mean.rgb) v = static_cast<float>(double{v} * power(sign * k));
      write_exr(file_of(sign * k), other);
    }
    return sweep;
  };
  return {sweep_run("file up", "10^k in the file", 1), sweep_run("file down", "10^-k in the file", -1)};
}

Sweep dark_among_bright() {
  return {"light point",
          "beside a dim one",
          "one light 10^k times as bright as another",
          {2, 6, 12, 20, 30},
          30,
          [](double k) {
            SceneDescription scene = stress_scene_under(PointLightDescription{above, RgbD(intensity)});
            scene.emitters.push_back({{}, "", PointLightDescription{{-2, 4, 1}, RgbD(intensity * power(-k) * 1e-2)}});
            return StressScene{scene};
          },
          [](double) {
            return StressScene{stress_scene_under(PointLightDescription{above, RgbD(intensity)})};
          }};
}

}  // namespace

std::vector<Sweep> light_sweeps(const std::filesystem::path& assets) {
  std::vector<Sweep> sweeps{tiny("sphere", SphereDescription{}, pi, true),
                            tiny("disk", DiskDescription{}, pi, false),
                            tiny("rectangle", RectangleDescription{}, 4, false),
                            tiny("cylinder", CylinderDescription{}, 2, false),
                            far("sphere", SphereDescription{}, pi),
                            far("disk", DiskDescription{}, pi),
                            far("rectangle", RectangleDescription{}, 4),
                            huge_ball(),
                            huge_plate("disk", DiskDescription{}),
                            huge_plate("rectangle", RectangleDescription{}),
                            dark_among_bright()};
  for (const std::vector<Sweep>& more : {point_lights(), angles_of_light(), near_the_floor(),
                                         lights_on_surfaces_of_rooms(), bright_and_dim_files(assets)})
    sweeps.insert(sweeps.end(), more.begin(), more.end());
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
