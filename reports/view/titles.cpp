#include "reports/view/titles.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace photonproof::reports::inline reports_view {
namespace {

using Titles = std::map<std::string, std::string>;  // by name

/// Leaves out titles that are used twice, or that are another one's name.
Titles unique_titles(const std::vector<std::pair<std::string, std::string>>& all) {
  Titles titles;
  for (const auto& [name, title] : all) {
    const auto clashes = std::ranges::count_if(all, [&, wanted = std::string_view(title)](const auto& other) {
      return other.second == wanted || other.first == wanted;
    });
    const bool is_own_name = title == name;
    titles[name] = title.empty() || clashes > (is_own_name ? 2 : 1) ? name : title;
  }
  return titles;
}

void replace(std::string& name, const Titles& titles) {
  if (const auto found = titles.find(name); found != titles.end()) name = found->second;
}

class Titling {
 public:
  explicit Titling(const Results& results) {
    std::vector<std::pair<std::string, std::string>> scenes, engines;
    for (const SceneRecord& scene : results.scenes) scenes.emplace_back(scene.name, scene.title);
    for (const EngineRecord& engine : results.engines) engines.emplace_back(engine.name, engine_title(engine));
    scenes_ = unique_titles(scenes);
    engines_ = unique_titles(engines);
  }

  /// Replaces both names of a cell, curve, gate or change.
  template <class Named>
  void rename(Named& named) const {
    replace(named.scene, scenes_);
    replace(named.engine, engines_);
  }

  void rename(RaceRecord& race) const {
    replace(race.scene, scenes_);
    for (RaceRecord::Time& time : race.times) replace(time.engine, engines_);
    for (RaceRecord::Error& error : race.errors) replace(error.engine, engines_);
  }

  void rename(SceneRecord& scene) const { replace(scene.name, scenes_); }

  void rename(EngineRecord& engine) const {
    const std::string name = engine.name;
    replace(engine.name, engines_);
    engine.title = engine.name == name ? engine.title : name;
  }

 private:
  Titles scenes_, engines_;
};

}  // namespace

std::string engine_title(const EngineRecord& engine) {
  constexpr std::string_view own = "photonproof ";
  if (engine.title.empty()) return engine.name;
  return engine.title.starts_with(own) ? engine.title.substr(own.size()) : engine.title;
}

Results titled(Results results) {
  const Titling titling(results);
  // A scene names its reference by the label of a cell, which has both names.
  Titles labels;
  for (Result& result : results.results) {
    const std::string label = result.cell.label();
    titling.rename(result.cell);
    labels[label] = result.cell.label();
  }
  for (SceneRecord& scene : results.scenes) {
    replace(scene.reference_label, labels);
    titling.rename(scene);
  }
  for (EngineRecord& engine : results.engines) titling.rename(engine);
  for (Convergence& curve : results.convergence) titling.rename(curve);
  for (RaceRecord& race : results.races) titling.rename(race);
  for (GateRecord& gate : results.gates) titling.rename(gate);
  for (ChangeRecord& change : results.changes) titling.rename(change);
  return results;
}

}  // namespace photonproof::reports::inline reports_view
