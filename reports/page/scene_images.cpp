#include "reports/page/scene_images.h"

#include <algorithm>

#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_page {
namespace {

SceneImage reference_of(const SceneView& scene) {
  SceneImage image;
  image.title = "reference";
  image.caption = reference_caption(scene);
  image.subject = "reference of " + scene.record.name + ": " + reference_text(scene);
  image.image = reference_image(scene);
  image.pictures = {{"image", reference_picture(scene)}};
  image.is_reference = true;
  return image;
}

std::string score(const Result& result, const char* title, const char* name) {
  const auto value = metric(result, name);
  return std::string(title) + " " + (value ? format_metric(name, *value) : std::string(undefined_number));
}

SceneImage engine_image(const View& view, const SceneView& scene, const EngineOutcome& outcome) {
  SceneImage image;
  image.title = view.engines[outcome.engine].name;
  image.subject = scene.record.name + " rendered by " + image.title;
  image.engine = outcome.engine;
  if (!outcome.shown) {
    image.problem = "no picture: " + to_string(outcome.cells.back()->status);
    image.caption = outcome.cells.back()->detail;
    return image;
  }
  const Result& shown = *outcome.shown;
  image.caption = budget_text(shown.cell.budget) + ", " +
                  or_dash(shown.wall_seconds, [](double v) { return significant(v); }) + " s";
  image.image = shown.image;
  image.pictures = shown.pictures;
  const std::string mark = doubt_mark(scene);
  image.scores = {{"flip", score(shown, "FLIP", "flip") + mark}, {"error", score(shown, "relMSE", "relmse") + mark}};
  return image;
}

SceneImage gate_image(const View& view, const GateRecord& gate) {
  SceneImage image;
  image.title = gate.name;
  image.caption = to_string(gate.verdict) + ", " + gate.engine;
  image.subject = gate.scene + " rendered by " + gate.engine + " for the gate " + gate.name;
  image.engine = engine_index(view, gate.engine);
  image.image = gate.image;
  image.pictures = gate.pictures;
  image.gate = &gate;
  return image;
}

std::string picture_of_gate(const GateRecord& gate) {
  return gate.image.empty() ? picture_file(gate.pictures, "image") : gate.image;
}

}  // namespace

std::vector<SceneImage> scene_images(const View& view, const SceneView& scene) {
  std::vector<SceneImage> images;
  if (has_reference(scene)) images.push_back(reference_of(scene));
  for (const EngineOutcome& outcome : scene.engines) {
    if (!outcome.cells.empty()) images.push_back(engine_image(view, scene, outcome));
  }
  std::vector<std::string> files;
  for (const GateRecord* gate : scene.gates) {
    const std::string file = picture_of_gate(*gate);
    if (file.empty() || std::ranges::find(files, file) != files.end()) continue;
    files.push_back(file);
    images.push_back(gate_image(view, *gate));
  }
  return images;
}

std::optional<std::size_t> image_of_gate(const std::vector<SceneImage>& images, const View& view,
                                         const GateRecord& gate) {
  const auto index = [&](auto matches) -> std::optional<std::size_t> {
    const auto found = std::ranges::find_if(images, matches);
    return found == images.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - images.begin()));
  };
  if (!picture_of_gate(gate).empty()) {
    return index(
        [&](const SceneImage& image) { return image.gate && picture_of_gate(*image.gate) == picture_of_gate(gate); });
  }
  return index([&](const SceneImage& image) { return image.engine == engine_index(view, gate.engine); });
}

}  // namespace photonproof::reports::inline reports_page
