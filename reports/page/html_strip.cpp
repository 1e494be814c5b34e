#include "reports/page/html_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reports/page/html_conclusions.h"
#include "reports/page/html_data.h"
#include "reports/view/numbers.h"
#include "reports/view/races.h"
#include "reports/view/text.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_page {
namespace {

using kainjow::mustache::data;
namespace fs = std::filesystem;

struct Shown {
  std::string file, title, caption;
  std::optional<std::size_t> engine{};
};

/// The images of one scene; empty: there is none to show.
struct Strip {
  const SceneView* scene = nullptr;
  std::vector<Shown> images, maps;
  const FailingTile* place = nullptr;  ///< where a gate fails
};

void add(Strip& strip, const View& view, const Result& result) {
  const std::size_t engine = engine_index(view, result.cell.engine);
  const std::string name = view.engines[engine].name;
  strip.images.push_back({picture_file(result.pictures, "image"), name,
                          budget_text(result.cell.budget) + ", " + seconds_text(result.wall_seconds) + " s, relMSE " +
                              metric_text(result, "relmse") + doubt_mark(*strip.scene),
                          engine});
  if (const std::string flip = picture_file(result.pictures, "flip"); !flip.empty())
    strip.maps.push_back({flip, "difference of " + name, "FLIP " + metric_text(result, "flip"), engine});
}

Strip strip_of_gate(const View& view, const GateRecord& gate) {
  Strip strip{find_scene(view, gate.scene), {}, {}, gate.tiles.empty() ? nullptr : &gate.tiles.front()};
  const std::string image = picture_file(gate.pictures, "image"), flip = picture_file(gate.pictures, "flip");
  if (strip.scene == nullptr || image.empty()) return {};
  strip.images.push_back(
      {image, gate.engine, to_string(gate.verdict) + ", gate " + gate.name, engine_index(view, gate.engine)});
  if (!flip.empty()) strip.maps.push_back({flip, "difference", "FLIP"});
  return strip;
}

/// The finished cells of an engine that have a picture and a time.
std::vector<const Result*> pictured(const SceneView& scene, const View& view, const std::string& engine) {
  std::vector<const Result*> cells;
  for (const EngineOutcome& outcome : scene.engines)
    if (view.engines[outcome.engine].name == engine)
      for (const Result* cell : outcome.cells)
        if (cell->status == Status::ok && cell->wall_seconds.value_or(0) > 0 &&
            !picture_file(cell->pictures, "image").empty())
          cells.push_back(cell);
  return cells;
}

Strip strip_of_race(const View& view, const RaceRecord& race) {
  Strip strip{find_scene(view, race.scene), {}, {}, nullptr};
  if (strip.scene == nullptr || race.times.size() < 2) return {};
  const Result *first = nullptr, *second = nullptr;
  double nearest = 0;
  for (const Result* a : pictured(*strip.scene, view, race.times[0].engine))
    for (const Result* b : pictured(*strip.scene, view, race.times[1].engine)) {
      const double apart = std::abs(std::log(*a->wall_seconds / *b->wall_seconds));
      if (first != nullptr && apart >= nearest) continue;
      first = a, second = b, nearest = apart;
    }
  if (first == nullptr) return {};
  add(strip, view, *first);
  add(strip, view, *second);
  return strip;
}

Strip strip_of_scene(const View& view, const SceneView& scene) {
  Strip strip{&scene, {}, {}, nullptr};
  constexpr std::size_t most = 2;
  for (const EngineOutcome& outcome : scene.engines)
    if (outcome.shown != nullptr && !picture_file(outcome.shown->pictures, "image").empty() &&
        strip.images.size() < most)
      add(strip, view, *outcome.shown);
  return strip;
}

/// The ratio of the second to the best, at the low end of its interval.
template <class Entries>
double lead_of(const Entries& entries) {
  if (entries.size() < 2 || !entries[1].ratio) return 0;
  const Estimate& ratio = *entries[1].ratio;
  return ratio.interval ? ratio.interval->low : ratio.value;
}

/// The first race whose errors in the same time differ tenfold, which any eye sees, in the suite's order. Else that
/// with the largest ratio of errors, else of times.
const RaceRecord* clearest_race(const View& view) {
  static constexpr double plain = 10;
  const RaceRecord* best = nullptr;
  const auto leads = [](const RaceRecord& race) {
    return std::pair(std::min(lead_of(race.errors), plain), lead_of(race.errors) < plain ? lead_of(race.times) : 0);
  };
  for (const RaceRecord* race : view.races)
    if (has_winner(*race) && (best == nullptr || leads(*race) > leads(*best))) best = race;
  return best;
}

Strip most_telling(const View& view) {
  if (!view.gates.empty() && view.gates.front()->verdict != GateVerdict::pass)
    if (Strip strip = strip_of_gate(view, *view.gates.front()); strip.scene != nullptr) return strip;
  if (const RaceRecord* race = clearest_race(view))
    if (Strip strip = strip_of_race(view, *race); strip.scene != nullptr) return strip;
  for (const SceneView& scene : view.scenes)
    if (has_reference(scene))
      if (Strip strip = strip_of_scene(view, scene); !strip.images.empty()) return strip;
  return {};
}

/// A frame around the place where a gate fails, in per cent of the picture's sides.
data frame_of(const Strip& strip) {
  const SceneRecord& scene = strip.scene->record;
  if (strip.place == nullptr || scene.width <= 0 || scene.height <= 0) return data(false);
  const FailingTile& place = *strip.place;
  const auto percent = [](int part, int whole) { return fmt::format("{:.2f}", 100.0 * part / whole); };
  data frame;
  frame.set("left", percent(place.x, scene.width));
  frame.set("top", percent(place.y, scene.height));
  frame.set("width", percent(place.width, scene.width));
  frame.set("height", percent(place.height, scene.height));
  frame.set("words", fmt::format("{} by {} pixels at ({}, {})", place.width, place.height, place.x, place.y));
  return frame;
}

}  // namespace

void set_strip(data& page, const View& view, const fs::path& folder) {
  Strip strip = most_telling(view);
  page.set("has_strip", data(false));
  if (strip.scene == nullptr) return;
  if (const std::string reference = reference_picture(*strip.scene); !reference.empty())
    strip.images.push_back({reference, "reference", reference_text(*strip.scene)});
  std::ranges::move(strip.maps, std::back_inserter(strip.images));

  constexpr std::size_t most_bytes = 200'000;
  std::vector<EmbeddedPicture> pictures;
  for (const int side : {320, 256, 192, 128, 64}) {
    pictures.clear();
    std::size_t bytes = 0;
    for (const Shown& shown : strip.images)
      bytes += pictures.emplace_back(embed_thumbnail(folder, shown.file, side)).uri.size();
    if (bytes <= most_bytes) break;
  }
  const data frame = frame_of(strip);
  data list(data::type::list);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!pictures[i].problem.empty()) continue;  // the scene's part of the page tells it
    const Shown& shown = strip.images[i];
    data item = shown.engine ? engine_data(view, *shown.engine) : data();
    item.set("has_swatch", shown.engine.has_value());
    item.set("title", printable(shown.title));
    item.set("caption", printable(shown.caption));
    set_picture(item, pictures[i], shown.title + ", " + strip.scene->record.name);
    item.set("picture_id", data(false));
    item.set("frame", frame);
    list.push_back(item);
  }
  data out;
  page.set("has_strip", list.is_non_empty_list());
  out.set("href", scene_id(view, strip.scene->record.name));
  out.set("scene", printable(strip.scene->record.name));
  out.set("pictures", list);
  page.set("strip", out);
}

}  // namespace photonproof::reports::inline reports_page
