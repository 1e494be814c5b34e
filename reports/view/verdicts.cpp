#include "reports/view/verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/view/numbers.h"

namespace photonproof::reports::inline reports_view {
namespace {

bool excludes_zero(const Interval& interval) { return interval.low > 0 || interval.high < 0; }

std::string percent(double fraction) { return significant(100 * fraction, 2) + " %"; }

std::string signed_text(double fraction) { return (fraction < 0 ? "−" : "+") + percent(std::abs(fraction)); }

constexpr const char* somewhere = "in places";

/// The number beside a verdict; empty if it has none.
std::string size_text(const CorrectnessRecord& record) {
  const bool judged = record.whole && record.whole->interval;
  switch (record.verdict) {
    case Correctness::right:
      return record.would_see ? "within " + percent(*record.would_see) : "";
    case Correctness::biased:
      return judged && excludes_zero(*record.whole->interval) ? signed_text(record.whole->value) : somewhere;
    case Correctness::noisy: {
      if (!judged) return "";
      const double half = (record.whole->interval->high - record.whole->interval->low) / 2;
      return half < 1 ? "±" + percent(half) : "beyond ±100 %";  // the error is then unknown
    }
    case Correctness::unknown:
      return record.whole ? signed_text(record.whole->value) : "";
  }
  return {};
}

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return text;
}

std::string glance(const View& view, std::size_t engine) {
  std::array<std::vector<std::string>, 4> scenes;
  std::vector<std::string> in_places;
  std::vector<std::string> unfinished;
  std::size_t asked = 0;
  for (const SceneView& scene : view.scenes) {
    const auto outcome = std::ranges::find(scene.engines, engine, &EngineOutcome::engine);
    if (outcome == scene.engines.end() || outcome->cells.empty()) continue;
    ++asked;
    if (outcome->shown == nullptr) {
      unfinished.push_back(scene.record.name);
      continue;
    }
    const CorrectnessRecord* record = correctness_of(scene, outcome->shown->cell);
    if (record == nullptr) continue;
    const std::string size = size_text(*record);
    const std::string name = scene.record.name + (record->regression_only.empty() ? "" : "*");
    if (size == somewhere)
      in_places.push_back(name);
    else
      scenes[static_cast<std::size_t>(record->verdict)].push_back(
          name + (size.empty() || record->verdict == Correctness::right ? "" : " (" + size + ")"));
  }
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  for (const Correctness verdict :
       {Correctness::right, Correctness::biased, Correctness::noisy, Correctness::unknown}) {
    const std::vector<std::string>& names = scenes[static_cast<std::size_t>(verdict)];
    if (names.empty()) continue;
    if (verdict == Correctness::right)
      add(fmt::format("right on {} of {} scene{}", names.size(), asked, asked == 1 ? "" : "s"));
    else
      add(to_string(verdict) + " on " + listed(names));
  }
  if (!in_places.empty()) add("biased in places on " + listed(in_places));
  if (!unfinished.empty()) add("did not finish " + listed(unfinished));
  return text;
}

}  // namespace

std::string verdict_text(const CorrectnessRecord& record) {
  const std::string size = size_text(record);
  std::string text = to_string(record.verdict) + (size.empty() ? "" : " " + size);
  if (record.verdict == Correctness::right && !record.regression_only.empty()) text += " (regression only)";
  return text;
}

std::string sentence_of(const CorrectnessRecord& record) {
  return record.sentence + (record.regression_only.empty() ? "" : "; regression only: " + record.regression_only);
}

std::string status_text(Status status) { return status == Status::ok ? "finished" : to_string(status); }

const CorrectnessRecord* correctness_of(const SceneView& scene, const Cell& cell) {
  for (const Convergence* curve : scene.curves) {
    if (curve->engine != cell.engine) continue;
    for (const ConvergencePoint& point : curve->points)
      if (point.budget == cell.budget && point.correctness) return &*point.correctness;
  }
  return nullptr;
}

const char* verdict_class(Correctness verdict) {
  return verdict == Correctness::right ? "good" : verdict == Correctness::biased ? "poor" : "open";
}

const char* verdict_symbol(Correctness verdict) {
  switch (verdict) {
    case Correctness::right:
      return "✓";
    case Correctness::biased:
      return "≠";
    case Correctness::noisy:
      return "≈";
    case Correctness::unknown:
      break;
  }
  return "?";
}

std::string doubt_mark(const SceneView& scene) { return scene.record.reference_doubt.empty() ? "" : " †"; }

std::string doubt_text(const SceneView& scene) {
  if (scene.record.reference_doubt.empty()) return {};
  return "† " + scene.record.reference_doubt + ": these numbers say how far from it an image is, not how wrong";
}

std::vector<EngineGlance> glances(const View& view) {
  std::vector<EngineGlance> out;
  for (const std::size_t engine : view.compared) {
    std::string text = glance(view, engine);
    if (!text.empty()) out.push_back({engine, std::move(text)});
  }
  return out;
}

std::vector<std::string> race_texts(const View& view) {
  std::vector<std::string> texts;
  for (const RaceRecord* race : view.races) {
    std::string text = fmt::format("{}, to relMSE {}:", race->scene, significant(race->relmse, 2));
    const RaceRecord::Time* before = nullptr;
    std::optional<double> fastest;  // a value: a bound gives no factor
    for (const RaceRecord::Time& time : race->times) {
      const bool first_without_rank = time.unranked && before != nullptr && !before->unranked;
      text += fmt::format("{} {} {}{} s",
                          before == nullptr    ? ""
                          : first_without_rank ? "; without a rank:"
                                               : ",",
                          time.engine,
                          time.at_most     ? "≤ "
                          : time.more_than ? "> "
                                           : "",
                          significant(time.seconds, 2));
      before = &time;
      if (time.at_most || time.more_than) continue;
      if (!fastest) fastest = time.seconds;
      if (time.seconds > *fastest) text += fmt::format(" (×{})", significant(time.seconds / *fastest, 2));
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

std::string verdict_lines(const View& view) {
  std::string text, doubts;
  for (const SceneView& scene : view.scenes) {
    for (const EngineOutcome& outcome : scene.engines) {
      if (outcome.shown == nullptr) continue;
      const Result& shown = *outcome.shown;
      const CorrectnessRecord* record = correctness_of(scene, shown.cell);
      if (record == nullptr) continue;
      text += fmt::format("{}, {}, {}: {}, relMSE {}{}, {} s\n", scene.record.name, shown.cell.engine,
                          budget_text(shown.cell.budget), verdict_text(*record),
                          or_dash(metric(shown, "relmse"), [](double v) { return significant(v); }), doubt_mark(scene),
                          or_dash(shown.wall_seconds, [](double v) { return significant(v); }));
    }
    for (const Convergence* curve : scene.curves)
      for (const std::string& caveat : curve->caveats)
        if (caveat.starts_with(declared_by_engine))
          text += fmt::format("{}, {}: {}\n", scene.record.name, curve->engine, caveat);
    if (const std::string doubt = doubt_text(scene); !doubt.empty()) doubts += scene.record.name + ": " + doubt + "\n";
  }
  return text + doubts;
}

}  // namespace photonproof::reports::inline reports_view
