#include "reports/view/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <tuple>

#include "reports/view/numbers.h"

namespace photonproof::reports::inline reports_view {
namespace {

template <class Record>
std::size_t index_of(std::vector<Record>& records, const std::string& name) {
  const auto found = std::find_if(records.begin(), records.end(), [&](const Record& r) { return r.name == name; });
  if (found != records.end()) return static_cast<std::size_t>(found - records.begin());
  records.emplace_back().name = name;
  return records.size() - 1;
}

void find_reference(const Results& results, SceneView& scene) {
  const std::string& label = scene.record.reference_label;
  if (label.empty()) {
    if (scene.record.reference) return;
    scene.reference_problem = "No reference is named for this scene, so there is nothing to measure errors against.";
    return;
  }
  const Result* found = results.find(label);
  if (!found) {
    scene.reference_problem = "The reference " + label + " is not among the results.";
  } else if (found->status != Status::ok) {
    scene.reference_problem =
        "The reference " + label + " did not finish (" + to_string(found->status) + "): " + found->detail;
  } else {
    scene.reference = found;
  }
}

/// Sorts by budget kind in order of appearance, amount and seed, and picks the cell to show.
void order_cells(EngineOutcome& outcome) {
  std::vector<std::string> kinds;
  for (const Result* cell : outcome.cells) {
    if (std::find(kinds.begin(), kinds.end(), cell->cell.budget.kind) == kinds.end()) {
      kinds.push_back(cell->cell.budget.kind);
    }
  }
  const auto rank = [&](const Result* r) {
    const auto kind = std::find(kinds.begin(), kinds.end(), r->cell.budget.kind) - kinds.begin();
    return std::make_tuple(kind, r->cell.budget.amount, r->cell.seed);
  };
  std::stable_sort(outcome.cells.begin(), outcome.cells.end(),
                   [&](const Result* a, const Result* b) { return rank(a) < rank(b); });
  for (const Result* cell : outcome.cells) {
    if (cell->status != Status::ok) continue;
    ++outcome.finished;
    if (!outcome.shown || !(outcome.shown->cell.budget == cell->cell.budget)) outcome.shown = cell;
  }
}

void add_once(std::vector<MetricParameters>& list, const MetricParameters& entry) {
  if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
}

/// Parameters that are equal everywhere go to the page, the others to their scenes.
void collect_parameters(View& view) {
  std::vector<MetricParameters> all;
  for (SceneView& scene : view.scenes) {
    for (const EngineOutcome& outcome : scene.engines) {
      for (const Result* cell : outcome.cells) {
        for (const MetricValue& value : cell->metrics) {
          if (value.parameters.empty()) continue;
          add_once(scene.parameters, {value.name, value.parameters});
          add_once(all, {value.name, value.parameters});
        }
      }
    }
  }
  const auto varies = [&](const MetricParameters& entry) {
    return std::count_if(all.begin(), all.end(), [&](const auto& other) { return other.metric == entry.metric; }) > 1;
  };
  for (SceneView& scene : view.scenes) {
    std::erase_if(scene.parameters, [&](const auto& e) { return !varies(e); });
    scene.parameters = merged(scene.parameters);
  }
  std::copy_if(all.begin(), all.end(), std::back_inserter(view.parameters), [&](const auto& e) { return !varies(e); });
}

void add_failure(std::vector<Failure>& failures, const Result& result) {
  if (result.status == Status::ok) return;
  const auto same = [&](const Failure& failure) {
    const Result& first = *failure.cells.front();
    return first.cell.scene == result.cell.scene && first.cell.engine == result.cell.engine &&
           first.status == result.status && first.detail == result.detail;
  };
  const auto group = std::ranges::find_if(failures, same);
  (group == failures.end() ? failures.emplace_back() : *group).cells.push_back(&result);
}

void collect_failures(const Results& results, View& view) {
  for (const SceneView& scene : view.scenes) {
    if (const Result* reference = results.find(scene.record.reference_label)) add_failure(view.failures, *reference);
    for (const EngineOutcome& outcome : scene.engines) {
      for (const Result* cell : outcome.cells) add_failure(view.failures, *cell);
    }
  }
}

/// Order of verdicts: fail, inconclusive, pass.
int badness(GateVerdict verdict) {
  return verdict == GateVerdict::fail ? 2 : verdict == GateVerdict::inconclusive ? 1 : 0;
}

int urgency(Change change) {
  switch (change) {
    case Change::regression:
      return 3;
    case Change::inconclusive:
      return 2;
    case Change::improvement:
      return 1;
    case Change::unchanged:
      break;
  }
  return 0;
}

void collect_conclusions(const Results& results, View& view) {
  const auto scene_of = [&](const std::string& name) -> SceneView& {
    return *std::ranges::find(view.scenes, name, [](const SceneView& scene) { return scene.record.name; });
  };
  for (const GateRecord& gate : results.gates) view.gates.push_back(&gate);
  std::ranges::stable_sort(view.gates, std::ranges::greater{},
                           [](const GateRecord* gate) { return badness(gate->verdict); });
  for (const GateRecord* gate : view.gates) {
    SceneView& scene = scene_of(gate->scene);
    if (scene.gates.empty()) scene.verdict = gate->verdict;
    scene.gates.push_back(gate);
    for (const FailingTile& tile : gate->tiles) view.tiles.push_back({gate, &tile});
  }
  std::ranges::stable_sort(view.tiles, std::ranges::greater{}, [](const RankedTile& t) { return t.tile->score; });
  for (const Convergence& curve : results.convergence) scene_of(curve.scene).curves.push_back(&curve);
  for (const RaceRecord& race : results.races) view.races.push_back(&race);
  for (const ChangeRecord& change : results.changes) view.changes.push_back(&change);
  std::ranges::stable_sort(view.changes, std::ranges::greater{},
                           [](const ChangeRecord* change) { return urgency(change->change); });
  std::ranges::stable_sort(view.scenes, std::ranges::greater{},
                           [](const SceneView& scene) { return scene.verdict ? badness(*scene.verdict) : 0; });
}

/// Scenes and engines that only a conclusion names.
void add_named(const Results& results, std::vector<SceneRecord>& scenes, std::vector<EngineRecord>& engines) {
  const auto add = [&](const auto& conclusion) {
    index_of(scenes, conclusion.scene);
    index_of(engines, conclusion.engine);
  };
  for (const GateRecord& gate : results.gates) add(gate);
  for (const Convergence& curve : results.convergence) add(curve);
}

}  // namespace

View arrange(const Results& results) {
  View view;
  view.engines = results.engines;
  std::vector<SceneRecord> scenes = results.scenes;
  struct Place {
    std::size_t scene, engine;
    bool is_reference;
  };
  std::vector<Place> places;
  for (const Result& result : results.results) {
    const std::size_t scene = index_of(scenes, result.cell.scene);
    places.push_back(
        {scene, index_of(view.engines, result.cell.engine), result.cell.label() == scenes[scene].reference_label});
  }
  add_named(results, scenes, view.engines);
  for (std::size_t e = 0; e < view.engines.size() && !results.results.empty(); ++e) {
    const auto is_its = [&](const Place& place) { return place.engine == e; };
    const auto is_its_cell = [&](const Place& place) { return place.engine == e && !place.is_reference; };
    if (std::ranges::any_of(places, is_its_cell) || std::ranges::none_of(places, is_its)) view.compared.push_back(e);
  }
  for (const SceneRecord& record : scenes) {
    SceneView& scene = view.scenes.emplace_back();
    scene.record = record;
    find_reference(results, scene);
    for (const std::size_t engine : view.compared) scene.engines.emplace_back().engine = engine;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].is_reference) continue;
    std::vector<EngineOutcome>& outcomes = view.scenes[places[i].scene].engines;
    std::ranges::find(outcomes, places[i].engine, &EngineOutcome::engine)->cells.push_back(&results.results[i]);
  }
  for (SceneView& scene : view.scenes) {
    for (EngineOutcome& outcome : scene.engines) order_cells(outcome);
  }
  collect_parameters(view);
  collect_conclusions(results, view);
  collect_failures(results, view);
  return view;
}

std::vector<MetricParameters> merged(const std::vector<MetricParameters>& parameters) {
  std::vector<MetricParameters> out;
  for (const MetricParameters& entry : parameters) {
    const auto same = std::ranges::find(out, entry.parameters, &MetricParameters::parameters);
    if (same == out.end()) {
      out.push_back(entry);
    } else {
      same->metric += ", " + entry.metric;
    }
  }
  return out;
}

bool has_reference(const SceneView& scene) { return scene.reference || scene.record.reference; }

std::string reference_text(const SceneView& scene) {
  if (scene.reference) return scene.reference->cell.engine + ", " + budget_text(scene.reference->cell.budget);
  if (!scene.record.reference) return "none";
  std::string text = "stored";
  const auto& provenance = scene.record.reference->provenance;
  if (const auto found = provenance.find("estimator"); found != provenance.end()) text += ": " + found->second;
  if (const auto found = provenance.find("samples"); found != provenance.end()) text += ", " + found->second + " spp";
  return text;
}

std::string reference_caption(const SceneView& scene) {
  const std::string text = reference_text(scene);
  if (scene.reference) {
    return text + ", " + or_dash(scene.reference->wall_seconds, [](double v) { return significant(v); }) + " s";
  }
  if (!scene.record.reference) return text;
  const auto& provenance = scene.record.reference->provenance;
  const auto found = provenance.find("standard_error");
  return found == provenance.end() ? text : text + ", standard error " + found->second;
}

std::string reference_picture(const SceneView& scene) {
  if (!scene.reference) return scene.record.reference ? scene.record.reference->picture : std::string();
  return picture_file(scene.reference->pictures, "image");
}

std::string picture_file(const std::map<std::string, std::string>& pictures, const std::string& role) {
  const auto found = pictures.find(role);
  return found == pictures.end() ? std::string() : found->second;
}

std::string clock_text(Clock clock) {
  return clock == Clock::wall ? "wall-clock seconds" : "processor seconds of all threads";
}

Clock clock_of(const View& view) {
  for (const SceneView& scene : view.scenes)
    if (!scene.curves.empty()) return scene.curves.front()->clock;
  return Clock::wall;
}

const SceneView* find_scene(const View& view, const std::string& name) {
  const auto found = std::ranges::find(view.scenes, name, [](const SceneView& scene) { return scene.record.name; });
  return found == view.scenes.end() ? nullptr : &*found;
}

std::string reference_image(const SceneView& scene) {
  if (scene.reference) return scene.reference->image;
  return scene.record.reference ? scene.record.reference->image : std::string();
}

std::optional<double> metric(const Result& result, const std::string& name) {
  for (const MetricValue& value : result.metrics) {
    if (value.name == name) return value.value;
  }
  return std::nullopt;
}

std::string budget_text(const Budget& budget) {
  const std::string amount = grouped(budget.amount);
  if (budget.kind == "quality") return "quality " + amount;
  const bool one = budget.amount == 1 && !budget.kind.empty() && budget.kind.back() == 's';
  return amount + " " + (one ? budget.kind.substr(0, budget.kind.size() - 1) : budget.kind);
}

std::string failed_cells_text(const Failure& failure) {
  const Cell& first = failure.cells.front()->cell;
  const std::string cell = fmt::format("{}, seed {}", budget_text(first.budget), first.seed);
  return failure.cells.size() == 1 ? cell : fmt::format("{} images, first {}", failure.cells.size(), cell);
}

std::string exposure_text(double stops) {
  return stops == 0 ? "exposure 0 EV" : fmt::format("exposure {}{:g} EV", stops < 0 ? "−" : "+", std::abs(stops));
}

std::string time_text(const std::string& created) {
  static const std::regex iso(R"((\d{4}-\d\d-\d\d)T(\d\d:\d\d:\d\d)(\.\d+)?Z)");
  std::smatch match;
  return std::regex_match(created, match, iso) ? match[1].str() + " " + match[2].str() + " UTC" : created;
}

const std::string& heading(const Results& results) { return results.title.empty() ? results.suite : results.title; }

std::string totals_text(const Results& results) {
  const std::size_t total = results.results.size();
  const auto failed = std::count_if(results.results.begin(), results.results.end(),
                                    [](const Result& r) { return r.status != Status::ok; });
  const auto count = [](std::size_t n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); };
  std::string text = count(results.scenes.size(), "scene") + ", " + count(results.engines.size(), "engine");
  if (total == 0 && !results.gates.empty()) return text;
  text += ", " + count(total, "image");
  if (total == 0) return text;
  return text + (failed == 0
                     ? ": all finished"
                     : fmt::format(": {} finished, {} did not", total - static_cast<std::size_t>(failed), failed));
}

std::string verdicts_text(const std::vector<const GateRecord*>& gates) {
  if (gates.empty()) return {};
  std::string text;
  const auto add = [&](GateVerdict verdict, const char* one, const char* several) {
    const auto n = std::ranges::count(gates, verdict, &GateRecord::verdict);
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, n == 1 ? one : several);
  };
  add(GateVerdict::pass, "passes", "pass");
  add(GateVerdict::fail, "fails", "fail");
  add(GateVerdict::inconclusive, "inconclusive", "inconclusive");
  return fmt::format("{} gate{}: {}", gates.size(), gates.size() == 1 ? "" : "s", text);
}

std::string failing_text(const View& view) {
  if (view.gates.empty() || view.gates.front()->verdict != GateVerdict::fail) return {};
  const GateRecord& worst = *view.gates.front();
  return worst.scene + " by " + worst.engine + ": " + worst.sentence.substr(0, worst.sentence.find(';'));
}

std::size_t engine_index(const View& view, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(view.engines, name, &EngineRecord::name) - view.engines.begin());
}

}  // namespace photonproof::reports::inline reports_view
