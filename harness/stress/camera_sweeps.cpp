#include <cmath>
#include <numbers>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep_rows.h"

namespace photonproof::inline harness_stress {
namespace {

double size_of(double k) { return std::pow(10.0, k); }

SceneDescription seen() {
  SceneDescription scene = lit_stress_scene();
  add_shape(scene, SphereDescription{}, standing({0, 1, 0}, 1), {0});
  return scene;
}

/// The camera is 10^k away, with a field of view so narrow that it sees what an orthographic camera sees.
Sweep telephoto() {
  const Vec3d direction = normalize(Vec3d{0, 7, 5});
  return {
      "camera perspective",
      "narrow and far",
      "from 10^k away",
      {4, 5, 6, 7, 9, 12},
      6,
      [=](double k) {
        SceneDescription scene = seen();
        PerspectiveDescription camera;
        const double away = size_of(k);
        camera.fov_degrees = 2 * std::atan(2 / away) * 180 / std::numbers::pi;
        camera.near_clip = 0.5 * away;
        camera.far_clip = 2 * away;
        scene.sensor.camera = camera;
        scene.sensor.to_world = Transform::look_at(direction * away, {0, 0, 0}, {0, 1, 0});
        return StressScene{scene};
      },
      [=](double) {
        SceneDescription scene = seen();
        scene.sensor.camera = OrthographicDescription{};
        scene.sensor.to_world = Transform::look_at(direction * 8, {0, 0, 0}, {0, 1, 0}) * Transform::scale({2, 2, 1});
        return StressScene{scene};
      }};
}

/// An endless floor under a sky of radiance 1, seen at a sine of 10^-k: radiance 1/2 everywhere.
Sweep grazing_view() {
  Sweep sweep{
      "camera orthographic", "grazing", "at a sine of 10^-k above a plane", {1, 2, 3, 4, 5, 6, 7, 9}, 6, [](double k) {
        SceneDescription scene = empty_stress_scene();
        add_shape(scene, PlaneDescription{}, lying({0, 0, 0}, 1), add_bsdf(scene, DiffuseDescription{}));
        scene.emitters.push_back({{}, "", ConstantLightDescription{}});
        const double sine = size_of(-k);
        const Vec3d from = Vec3d{std::sqrt(1 - sine * sine), sine, 0} * 2.0;
        scene.sensor.camera = OrthographicDescription{};
        scene.sensor.to_world =
            Transform::look_at(from + Vec3d{0, 1, 0}, {0, 1, 0}, {0, 1, 0}) * Transform::scale({0.5, 0.5, 1});
        auto& camera = std::get<OrthographicDescription>(scene.sensor.camera);
        camera.far_clip = 1e3 / sine;
        return StressScene{scene};
      }};
  sweep.radiance = 0.5;
  sweep.engines = {"path", "photonmapper", "bdpt", "volpath"};
  return sweep;
}

Sweep clips() {
  return {"camera perspective",
          "clipping planes",
          "at 10^-k and 10^k",
          {3, 6, 9, 15, 30, 37, 45},
          30,
          [](double k) {
            SceneDescription scene = seen();
            auto& camera = std::get<PerspectiveDescription>(scene.sensor.camera);
            camera.near_clip = size_of(-k);
            camera.far_clip = size_of(k);
            return StressScene{scene};
          },
          [](double) { return StressScene{seen()}; }};
}

/// [-1,1]^2 of squares under a sky, seen from straight above. They fill the picture, which is the same through any
/// lens.
SceneDescription squares() {
  SceneDescription scene = empty_stress_scene();
  scene.textures.push_back({{}, "squares", CheckerboardDescription{RgbD(0.8), RgbD(0.2), Transform::scale(Vec3d(2))}});
  add_shape(scene, RectangleDescription{}, lying({0, 0, 0}, 1), add_bsdf(scene, DiffuseDescription{TextureIndex{0}}));
  scene.emitters.push_back({{}, "", ConstantLightDescription{}});
  return scene;
}

PerspectiveDescription from_above(SceneDescription& scene, double height) {
  PerspectiveDescription camera;
  camera.fov_degrees = 2 * std::atan(1 / height) * 180 / std::numbers::pi;
  camera.near_clip = 1e-3 * height;
  scene.sensor.to_world = Transform::look_at({0, height, 0}, {0, 0, 0}, {0, 0, -1});
  return camera;
}

const std::vector<std::string> through_lenses{"path", "bdpt", "ptracer"};

Sweep wide_field() {
  const auto from = [](double k) {
    SceneDescription scene = squares();
    scene.sensor.camera = from_above(scene, size_of(-k));
    return StressScene{scene};
  };
  Sweep sweep{"camera perspective",
              "wide view",
              "a field of view of 180 - 114 10^-k degrees",
              {1, 2, 3, 4, 6, 9},
              6,
              from,
              [=](double) { return from(0); }};
  sweep.engines = through_lenses;
  return sweep;
}

/// Off the axes, directions are accurate to 10^-7, and the steepest go far.
Sweep along_no_axis(const Sweep& straight, const std::vector<double>& heights, double wanted) {
  Sweep sweep = turned(straight);
  sweep.heights = heights;
  sweep.wanted = wanted;
  sweep.quick = heights.back();
  return sweep;
}

/// `lens` sets aperture and focus from 10^k so that squares at a distance of 2 are sharp.
Sweep lens_of(const char* sweep_run, const char* measure, const std::vector<double>& heights, double wanted,
              const std::function<void(double, ThinLensDescription&)>& lens) {
  Sweep sweep{"camera thinlens",
              sweep_run,
              measure,
              heights,
              wanted,
              [=](double k) {
                SceneDescription scene = squares();
                ThinLensDescription camera{from_above(scene, 2), 0, 2};
                lens(size_of(k), camera);
                scene.sensor.camera = camera;
                return StressScene{scene};
              },
              [](double) {
                SceneDescription scene = squares();
                scene.sensor.camera = from_above(scene, 2);
                return StressScene{scene};
              }};
  sweep.engines = through_lenses;
  return sweep;
}

std::vector<Sweep> lenses() {
  constexpr double narrow = 1e-6;
  return {
      lens_of("wide lens", "an aperture of 10^k", {0, 1, 2, 3, 4, 5, 6, 9, 15}, 3,
              [](double x, ThinLensDescription& c) { c.aperture_radius = x; }),
      lens_of("narrow lens", "an aperture of 10^-k", {3, 9, 20, 37}, 37,
              [](double x, ThinLensDescription& c) { c.aperture_radius = 1 / x; }),
      lens_of("near focus", "sharp at 10^-k, a millionth as wide", {3, 9, 20, 30}, 30,
              [](double x, ThinLensDescription& c) {
                c.focus_distance = 1 / x;
                c.aperture_radius = narrow / x;
              }),
      lens_of("far focus", "sharp at 10^k, a millionth wide", {3, 9, 20, 30}, 30, [](double x, ThinLensDescription& c) {
        c.focus_distance = x;
        c.aperture_radius = narrow;
      })};
}

/// A room has radiance 1 in every direction, through any filter.
Sweep narrow_filter() {
  Sweep sweep{
      "image", "narrow filter", "a tent of a radius of 10^-k pixels", {0, 1, 2, 3, 6, 12, 30}, 30, [](double k) {
        SceneDescription scene = closed_sphere(0.5, 0.5);
        scene.sensor.film.filter = {.kind = ReconstructionFilter::Kind::tent, .radius = size_of(-k)};
        return StressScene{scene, 8, 8};
      }};
  sweep.radiance = 1;
  sweep.engines = through_lenses;
  return sweep;
}

Sweep image_size(const char* sweep_run, int width, int height, const std::vector<double>& heights, double wanted) {
  Sweep sweep{"image", sweep_run, "10^k pixels", heights, wanted, [=](double k) {
                const int n = static_cast<int>(std::lround(size_of(k)));
                StressScene level{closed_sphere(0.5, 0.5), width > 0 ? width : n, height > 0 ? height : n};
                // Rays start at a depth, and the outermost are far from the axis there.
                std::get<PerspectiveDescription>(level.scene.sensor.camera).near_clip = 1e-6;
                return level;
              }};
  sweep.radiance = 1;
  return sweep;
}

}  // namespace

std::vector<Sweep> camera_sweeps(const std::filesystem::path&) {
  Sweep high = image_size("high image", 1, 0, {0, 1, 2, 3, 4, 4.4771212547}, 4);
  high.engines = {"path", "photonmapper", "bdpt", "volpath"};  // light tracing is slow here, and does the same for both
  const std::vector<Sweep> by_lens = lenses();
  std::vector<Sweep> sweeps{telephoto(),
                            grazing_view(),
                            clips(),
                            wide_field(),
                            along_no_axis(wide_field(), {1, 2, 3, 4, 5, 6, 9}, 4),
                            along_no_axis(by_lens[0], {0, 1, 2, 3, 4, 6}, 2),
                            narrow_filter(),
                            image_size("wide image", 0, 1, {0, 1, 2, 3, 4, 4.4771212547}, 4),
                            high};
  sweeps.insert(sweeps.end(), by_lens.begin(), by_lens.end());
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
