#include <cmath>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep_rows.h"

namespace photonproof::inline harness_stress {
namespace {

double tens(double k) { return std::pow(10.0, k); }

/// Light through glass and light between walls: both maps hold photons.
SceneDescription with_glass() { return stress_scene_with_bsdf(DielectricDescription{}); }

/// Every photon leaves the scene; the floor has no light.
SceneDescription under_a_light_that_looks_away() {
  SceneDescription scene = with_glass();
  for (ShapeDescription& shape : scene.shapes)
    if (shape.radiance) shape.to_world = lying({1, 5, -1}, 1);
  return scene;
}

Sweep photons(const char* feature, const char* sweep_run, const char* measure, const std::vector<double>& heights,
              double wanted, const std::function<StressScene(double)>& level) {
  Sweep sweep{feature, sweep_run, measure, heights, wanted, level, [](double) { return StressScene{with_glass()}; }};
  sweep.engines = {"photonmapper"};
  sweep.compared_with = "bdpt";
  return sweep;
}

/// A radius of 0 is left to the renderer.
StressScene of_radii(double global, double caustic, const std::string& indirect) {
  SceneDescription scene = with_glass();
  PhotonMapperDescription method;
  method.global_radius = global;
  method.caustic_radius = caustic;
  scene.integrator.method = method;
  StressScene level{scene};
  level.unlike_path = {"--indirect", indirect};
  // All photons are in every disc of a large radius, and a cache gathers them at hundreds of thousands of places.
  if (indirect == "cache") level.unlike_path.insert(level.unlike_path.end(), {"--photons", "30000"});
  return level;
}

}  // namespace

std::vector<Sweep> photon_sweeps(const std::filesystem::path&) {
  std::vector<Sweep> sweeps;
  for (const char* indirect : {"map", "gather", "cache"}) {
    const std::string feature = "photons, " + std::string(indirect);
    sweeps.push_back(photons(feature.c_str(), "radius up", "radii of 10^k", {-1, 0, 1, 2, 3, 6, 9, 20, 37, 45}, 9,
                             [=](double k) { return of_radii(tens(k), tens(k), indirect); }));
    sweeps.push_back(photons(feature.c_str(), "radius down", "radii of 10^-k", {1, 2, 3, 4, 6, 9, 20, 37, 45}, 9,
                             [=](double k) { return of_radii(tens(-k), tens(-k), indirect); }));
    sweeps.push_back(photons(feature.c_str(), "caustic radius down", "that radius alone, 10^-k", {1, 2, 3, 4, 6, 9, 20},
                             9, [=](double k) { return of_radii(0, tens(-k), indirect); }));
    sweeps.push_back(photons(feature.c_str(), "none, one, two", "k photons", {0, 1, 2, 3}, -1, [=](double k) {
      StressScene level{with_glass()};
      level.unlike_path = {"--indirect", indirect, "--photons", std::to_string(std::lround(k))};
      return level;
    }));
    sweeps.back().goes_on = true;
    sweeps.push_back(photons(feature.c_str(), "empty maps", "10^k photons that hit nothing", {3, 5}, 5, [=](double k) {
      StressScene level{under_a_light_that_looks_away()};
      level.unlike_path = {"--indirect", indirect, "--photons", std::to_string(std::lround(tens(k)))};
      return level;
    }));
    sweeps.back().alike = {};
    sweeps.back().radiance = 0;
    sweeps.push_back(photons(feature.c_str(), "few", "10^(6-k) photons", {0, 1, 2, 3, 4, 5, 6}, 6, [=](double k) {
      StressScene level{with_glass()};
      level.unlike_path = {"--indirect", indirect, "--photons", std::to_string(std::lround(tens(6 - k)))};
      return level;
    }));
  }
  Sweep many = photons("photons, map", "many", "10^k photons", {6, 7, 8}, 8, [](double k) {
    StressScene level{with_glass()};
    level.unlike_path = {"--indirect", "map", "--photons", std::to_string(std::lround(tens(k)))};
    return level;
  });
  many.quick = 7;
  sweeps.push_back(many);
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
