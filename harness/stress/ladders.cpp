#include <cmath>

#include "harness/stress/climbs.h"
#include "harness/stress/ladder.h"
#include "harness/stress/ladder_rows.h"
#include "harness/stress/stage.h"

namespace photonproof::inline harness_stress {
namespace {

using SceneChange = std::function<SceneDescription(const SceneDescription&, double)>;

struct WholeSceneClimb {
  const char *climb, *measure;
  std::vector<double> heights;
  double wanted;
  SceneChange change;
  std::function<double(double)> factor = [](double) { return 1.0; };
};

/// What every feature has to stand. 37 is near the end of single precision, 45 beyond it.
std::vector<WholeSceneClimb> whole_scene_climbs() {
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
       "every lamp times 10^k",
       {6, 15, 20, 25, 30, 36, 40},
       30,
       [=](const SceneDescription& s, double k) { return brighter(s, ten(k)); },
       ten},
      {"radiance down",
       "every lamp times 10^-k",
       {6, 15, 20, 25, 30, 36, 40, 50},
       30,
       [=](const SceneDescription& s, double k) { return brighter(s, ten(-k)); },
       [=](double k) { return ten(-k); }},
  };
}

void add_climbs_of(const std::string& feature, const SceneDescription& scene, const std::vector<std::string>& engines,
                   std::vector<Ladder>& ladders) {
  for (const WholeSceneClimb& climb : whole_scene_climbs()) {
    Ladder ladder;
    ladder.feature = feature;
    ladder.climb = climb.climb;
    ladder.measure = climb.measure;
    ladder.heights = climb.heights;
    ladder.wanted = climb.wanted;
    ladder.factor = climb.factor;
    ladder.rung = [scene, change = climb.change](double k) { return StressScene{change(scene, k)}; };
    ladder.alike = [scene](double) { return StressScene{scene}; };
    ladder.engines = engines;
    ladders.push_back(std::move(ladder));
  }
}

void add_whole_scene_ladders(const std::filesystem::path& assets, std::vector<Ladder>& ladders) {
  const std::vector<NamedScene> scenes = scenes_of_features(assets);
  for (const auto& [feature, scene] : scenes)
    add_climbs_of(feature, scene,
                  feature == "medium homogeneous" ? std::vector<std::string>{"volpath"} : std::vector<std::string>{},
                  ladders);
  // Those that climb nothing else by themselves.
  for (const char* engine : {"direct", "sppm", "whitted"})
    add_climbs_of("integrator " + std::string(engine), scenes.front().second, {engine}, ladders);
}

}  // namespace

Ladder turned(Ladder ladder) {
  ladder.climb += ", turned";
  ladder.is_turned = true;
  ladder.rung = [straight = std::move(ladder.rung)](double k) {
    StressScene scene = straight(k);
    if (scene.replaced.empty()) scene.scene = turned(std::move(scene.scene));
    return scene;
  };
  return ladder;
}

const std::vector<std::string>& stress_engines() {
  static const std::vector<std::string> engines{"path", "photonmapper", "bdpt", "ptracer", "volpath"};
  return engines;
}

std::vector<Ladder> stress_ladders(const std::filesystem::path& assets) {
  std::vector<Ladder> ladders;
  add_whole_scene_ladders(assets, ladders);
  for (const auto& rows : {shape_ladders, material_ladders, light_ladders, huge_lamp_ladders, camera_ladders,
                           photon_ladders, input_ladders, metric_ladders, format_ladders})
    for (Ladder& ladder : rows(assets)) ladders.push_back(std::move(ladder));
  return ladders;
}

}  // namespace photonproof::inline harness_stress
