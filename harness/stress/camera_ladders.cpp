#include <cmath>
#include <numbers>

#include "harness/stress/ladder_rows.h"
#include "harness/stress/stage.h"

namespace photonproof {
namespace {

double size_of(double k) { return std::pow(10.0, k); }

SceneDescription seen() {
  SceneDescription scene = lit_stage();
  add_shape(scene, SphereDescription{}, standing({0, 1, 0}, 1), {0});
  return scene;
}

/// From 10^k away, as narrow as to see what an orthographic camera does.
Ladder telephoto() {
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

/// A floor without end under a sky of radiance 1, seen at a sine of 10^-k: half of it, wherever one looks.
Ladder grazing_view() {
  Ladder ladder{
      "camera orthographic", "grazing", "at a sine of 10^-k above a plane", {1, 2, 3, 4, 5, 6, 7, 9}, 6, [](double k) {
        SceneDescription scene = empty_stage();
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
  ladder.radiance = 0.5;
  ladder.engines = {"path", "photonmapper", "bdpt", "volpath"};
  return ladder;
}

Ladder clips() {
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

Ladder image_size(const char* climb, int width, int height, const std::vector<double>& heights, double wanted) {
  Ladder ladder{"image", climb, "10^k pixels", heights, wanted, [=](double k) {
                  const int n = static_cast<int>(std::lround(size_of(k)));
                  StressScene rung{closed_sphere(0.5, 0.5), width > 0 ? width : n, height > 0 ? height : n};
                  // Rays start at a depth, and the outermost are far from the axis there.
                  std::get<PerspectiveDescription>(rung.scene.sensor.camera).near_clip = 1e-6;
                  return rung;
                }};
  ladder.radiance = 1;
  return ladder;
}

}  // namespace

std::vector<Ladder> camera_ladders(const std::filesystem::path&) {
  return {telephoto(), grazing_view(), clips(), image_size("wide", 0, 1, {0, 1, 2, 3, 4, 4.4771212547}, 4),
          image_size("high", 1, 0, {0, 1, 2, 3, 4, 4.4771212547}, 4)};
}

}  // namespace photonproof
