#include <cmath>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep.h"
#include "harness/stress/sweep_rows.h"
#include "harness/stress/sweep_runs.h"

namespace photonproof::inline harness_stress {
namespace {

using SceneChange = std::function<SceneDescription(const SceneDescription&, double)>;

struct WholeSceneSweepRun {
  const char *sweep_run, *measure;
  std::vector<double> heights;
  double wanted;
  SceneChange change;
  std::function<double(double)> factor = [](double) { return 1.0; };
};

/// The sweeps that every feature must pass. 37 is near the end of single precision, 45 beyond it.
std::vector<WholeSceneSweepRun> whole_scene_sweep_runs() {
  const auto ten = [](double k) { return std::pow(10.0, k); };
  return {
      {"scale up",
       "a unit of length of 10^-k",
       {3, 6, 9, 12, 15, 20, 37, 45},
       15,
       [=](const SceneDescription& s, double k) { return in_another_unit(s, ten(k)); }},
      {"scale down",
       "a unit of length of 10^k",
       {3, 6, 9, 12, 15, 20, 37, 45},
       15,
       [=](const SceneDescription& s, double k) { return in_another_unit(s, ten(-k)); }},
      {"translation",
       "moved by 10^k",
       {3, 5, 7, 9, 11, 13, 15},
       9,
       [=](const SceneDescription& s, double k) {
         return moved(s, Vec3d{0.6, -0.64, 0.48} * ten(k));
       }},
      {"radiance up",
       "every light times 10^k",
       {6, 15, 20, 25, 30, 36, 40},
       30,
       [=](const SceneDescription& s, double k) { return brighter(s, ten(k)); },
       ten},
      {"radiance down",
       "every light times 10^-k",
       {6, 15, 20, 25, 30, 36, 40, 50},
       30,
       [=](const SceneDescription& s, double k) { return brighter(s, ten(-k)); },
       [=](double k) { return ten(-k); }},
  };
}

void add_sweep_runs_of(const std::string& feature, const SceneDescription& scene,
                       const std::vector<std::string>& engines, std::vector<Sweep>& sweeps) {
  for (const WholeSceneSweepRun& sweep_run : whole_scene_sweep_runs()) {
    Sweep sweep;
    sweep.feature = feature;
    sweep.sweep_run = sweep_run.sweep_run;
    sweep.measure = sweep_run.measure;
    sweep.heights = sweep_run.heights;
    sweep.wanted = sweep_run.wanted;
    sweep.factor = sweep_run.factor;
    sweep.level = [scene, change = sweep_run.change](double k) { return StressScene{change(scene, k)}; };
    sweep.alike = [scene](double) { return StressScene{scene}; };
    sweep.engines = engines;
    sweeps.push_back(std::move(sweep));
  }
}

void add_whole_scene_sweeps(const std::filesystem::path& assets, std::vector<Sweep>& sweeps) {
  const std::vector<NamedScene> scenes = scenes_of_features(assets);
  for (const auto& [feature, scene] : scenes)
    add_sweep_runs_of(
        feature, scene,
        feature == "medium homogeneous" ? std::vector<std::string>{"volpath"} : std::vector<std::string>{}, sweeps);
  // The engines that have no other sweeps.
  for (const char* engine : {"direct", "sppm", "whitted"})
    add_sweep_runs_of("integrator " + std::string(engine), scenes.front().second, {engine}, sweeps);
}

}  // namespace

Sweep turned(Sweep sweep) {
  sweep.sweep_run += ", turned";
  sweep.is_turned = true;
  sweep.level = [straight = std::move(sweep.level)](double k) {
    StressScene scene = straight(k);
    if (scene.replaced.empty()) scene.scene = turned(std::move(scene.scene));
    return scene;
  };
  return sweep;
}

const std::vector<std::string>& stress_engines() {
  static const std::vector<std::string> engines{"path", "photonmapper", "bdpt", "ptracer", "volpath"};
  return engines;
}

std::vector<Sweep> stress_sweeps(const std::filesystem::path& assets) {
  std::vector<Sweep> sweeps;
  add_whole_scene_sweeps(assets, sweeps);
  for (const auto& rows : {shape_sweeps, material_sweeps, light_sweeps, huge_light_sweeps, camera_sweeps, photon_sweeps,
                           input_sweeps, metric_sweeps, format_sweeps})
    for (Sweep& sweep : rows(assets)) sweeps.push_back(std::move(sweep));
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
