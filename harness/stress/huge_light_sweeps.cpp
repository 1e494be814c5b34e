// Lights of size 10^k whose nearest point is 12 above the floor. Only the floor is seen; its irradiance is known for
// any size. Most lights are tilted, since axis-aligned shapes avoid most roundings.
#include <cmath>
#include <numbers>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep_rows.h"

namespace photonproof::inline harness_stress {
namespace {

constexpr double above_floor = 12, light_tilt = 30, floor_albedo = 0.5;
/// A cylinder of this many radii counts as endless, to 1e-4 of its light.
constexpr double long_for_its_radius = 200;

struct HugeLight {
  const char *shape, *sweep_run;
  std::vector<double> heights;
  std::function<void(SceneDescription&, double size)> add;
  /// Irradiance of the floor over pi times the radiance.
  std::function<double(double size)> share;
};

ShapeDescription& add_light(SceneDescription& scene, const Geometry& geometry, const Transform& to_world) {
  ShapeDescription& light = add_shape(scene, geometry, to_world, add_bsdf(scene, DiffuseDescription{RgbD(0.0)}));
  light.radiance = RgbD(1.0);
  return light;
}

/// A rotation around the light's middle.
Transform tilted() { return Transform::translate({0, above_floor, 0}) * Transform::rotate({0, 0, 1}, light_tilt); }

/// An endless plane that is tilted by t lights the floor with (1 + cos t)/2 of the sky's light.
double share_of_plane(double) { return (1 + std::cos(light_tilt * std::numbers::pi / 180)) / 2; }
double all_around(double) { return 1; }

/// A tube whose nearest line is at height 0. The tube lies above it, or below it where its inside emits.
Geometry lying_tube(double radius, bool inward) {
  const double half = long_for_its_radius / 2 * radius, middle = inward ? -radius : radius;
  return CylinderDescription{{-half, middle, 0}, {half, middle, 0}, radius};
}
Transform straight() { return Transform::translate({0, above_floor, 0}); }

std::vector<HugeLight> huge_lights(const std::filesystem::path& assets) {
  const std::vector<double> round{2, 3, 4, 5, 6, 7, 8, 9, 11, 13}, flat{4, 5, 6, 7, 8, 9, 11};
  // At 10^7 the round ones, too, are flat to a thousandth of their light.
  const std::vector<double> all_but_flat{7, 8, 9, 11, 13};
  const auto plate = [=](const char* shape, const Geometry& geometry) {
    return HugeLight{shape, "huge and tilted", flat,
                     [=](SceneDescription& s, double size) { add_light(s, geometry, tilted() * hanging({}, size)); },
                     share_of_plane};
  };
  const MeshDescription square =
      mesh_file(assets, "square", mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  return {plate("rectangle", RectangleDescription{}),
          plate("disk", DiskDescription{}),
          plate("mesh", square),
          {"cube", "huge and tilted", flat,
           [](SceneDescription& s, double size) {
             add_light(s, CubeDescription{}, tilted() * hanging({0, size, 0}, size));
           },
           share_of_plane},
          {"sphere", "huge, over a floor", round,
           [](SceneDescription& s, double size) {
             add_light(s, SphereDescription{}, straight() * standing({0, size, 0}, size));
           },
           [](double size) { return std::pow(size / (size + above_floor), 2); }},
          {"sphere", "huge and tilted", all_but_flat,
           [](SceneDescription& s, double size) {
             add_light(s, SphereDescription{}, tilted() * standing({0, size, 0}, size));
           },
           share_of_plane},
          {"sphere", "huge, around a floor", round,
           [](SceneDescription& s, double size) {
             add_light(s, SphereDescription{}, tilted() * standing({0, -size, 0}, size)).flip_normals = true;
           },
           all_around},
          {"cylinder", "huge, over a floor", round,
           [](SceneDescription& s, double size) { add_light(s, lying_tube(size, false), straight()); },
           [](double size) { return size / (size + above_floor); }},
          {"cylinder", "huge and tilted", all_but_flat,
           [](SceneDescription& s, double size) { add_light(s, lying_tube(size, false), tilted()); }, share_of_plane},
          {"cylinder", "huge, around a floor", round,
           [](SceneDescription& s, double size) { add_light(s, lying_tube(size, true), tilted()).flip_normals = true; },
           all_around}};
}

/// Something tiny in a corner that makes the renderer trace rays in another way.
struct OtherLights {
  const char* name;
  std::function<void(SceneDescription&)> add;
  std::vector<std::string> engines;  ///< The engines that it affects.
};

ShapeDescription& add_in_a_corner(SceneDescription& scene, const Geometry& geometry, const BsdfModel& model) {
  return add_shape(scene, geometry, Transform::translate({7.9, 1e-3, 7.9}) * Transform::scale(Vec3d(1e-3)),
                   add_bsdf(scene, model));
}

std::vector<OtherLights> other_lights() {
  std::vector<std::string> all = stress_engines();
  all.emplace_back("whitted");
  return {
      {"", [](SceneDescription&) {}, all},
      {", in a hierarchy",  // no scene with a cylinder is a list of primitives
       [](SceneDescription& scene) { add_in_a_corner(scene, CylinderDescription{}, DiffuseDescription{RgbD(0.0)}); },
       all},
      {", beside a medium",
       [](SceneDescription& scene) {
         scene.media.push_back({{}, "fog", HomogeneousDescription{RgbD(1.0), RgbD(0.0), 1, {}}});
         add_in_a_corner(scene, SphereDescription{}, NullDescription{}).interior = MediumIndex{0};
       },
       {"volpath", "bdpt"}}};
}

}  // namespace

std::vector<Sweep> huge_light_sweeps(const std::filesystem::path& assets) {
  std::vector<Sweep> sweeps;
  for (const HugeLight& light : huge_lights(assets))
    for (const OtherLights& others : other_lights()) {
      Sweep sweep;
      sweep.feature = "light " + std::string(light.shape);
      sweep.sweep_run = light.sweep_run + std::string(others.name);
      sweep.measure = "a radius or half width of 10^k";
      sweep.heights = light.heights;
      sweep.wanted = 9;
      sweep.level = [=](double k) {
        SceneDescription scene = stress_scene_floor();
        light.add(scene, std::pow(10.0, k));
        others.add(scene);
        return StressScene{scene};
      };
      sweep.radiance = floor_albedo;
      sweep.factor = [=](double k) { return light.share(std::pow(10.0, k)); };
      sweep.engines = others.engines;
      sweeps.push_back(std::move(sweep));
    }
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
