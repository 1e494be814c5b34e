#include "reports/paper/paper_words.h"

#include <algorithm>

#include "reports/view/text.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_paper {
using namespace reports;

std::string scene_title(const SceneRecord& scene) {
  if (!scene.title.empty()) return scene.title;
  std::string title = scene.name;
  std::ranges::replace(title, '-', ' ');
  std::ranges::replace(title, '_', ' ');
  return capitalised(title);
}

std::string scene_title(const View& view, const std::string& name) {
  if (const SceneView* scene = find_scene(view, name)) return scene_title(scene->record);
  SceneRecord unknown;
  unknown.name = name;
  return scene_title(unknown);
}

std::vector<std::string> method_titles(const View& view) {
  constexpr std::string_view own = "photonproof ";
  std::vector<std::string> titles;
  for (const EngineRecord& engine : view.engines) {
    const std::string_view title = engine.title.empty() ? engine.name : engine.title;
    titles.push_back(capitalised(std::string(title.starts_with(own) ? title.substr(own.size()) : title)));
  }
  std::vector<std::string> unique = titles;
  for (std::size_t i = 0; i < titles.size(); ++i)
    if (std::ranges::count(titles, titles[i]) > 1) unique[i] = view.engines[i].name;
  return unique;
}

std::string method_title(const View& view, const std::string& name) {
  const std::size_t index = engine_index(view, name);
  return index < view.engines.size() ? method_titles(view)[index] : name;
}

const SceneView& scene_of(const View& view, const std::string& name) {
  if (const SceneView* scene = find_scene(view, name)) return *scene;
  std::string known;
  for (const SceneView& scene : view.scenes) known += (known.empty() ? "" : ", ") + scene.record.name;
  throw InputError("--scene", "the record has no scene " + name + "; it has " + (known.empty() ? "none" : known));
}

}  // namespace photonproof::inline reports_paper
