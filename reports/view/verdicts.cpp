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

/// The bias of a block, or the most that it can be where the block alone does not prove it. A bound of 100 % and more
/// is that of a rare bright sample that no seed met, and tells nothing.
std::string block_text(const Estimate& block) {
  const Interval at = block.interval.value_or(Interval{block.value, block.value});
  const double most = std::max(std::abs(at.low), std::abs(at.high));
  if (excludes_zero(at) || most >= 1) return signed_text(block.value) + " in a block";
  return "at most " + percent(most) + " of a block";
}

/// The number beside a verdict; empty if it has none.
std::string size_text(const CorrectnessRecord& record) {
  const bool judged = record.whole && record.whole->interval;
  switch (record.verdict) {
    case Correctness::right:
      return record.would_see ? "within " + percent(*record.would_see) : "";
    case Correctness::biased:
      if (judged && excludes_zero(*record.whole->interval)) return signed_text(record.whole->value);
      return record.block ? block_text(*record.block) : "in places";  // older records lack the size
    case Correctness::noisy: {
      if (!judged) return "";
      const double half = (record.whole->interval->high - record.whole->interval->low) / 2;
      return half < 1 ? "±" + percent(half) : "beyond measure";
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

std::optional<SeenBias> seen_bias(const CorrectnessRecord& record) {
  if (record.verdict != Correctness::biased) return std::nullopt;
  if (record.whole && record.whole->interval && excludes_zero(*record.whole->interval))
    return SeenBias{std::abs(record.whole->value), false};
  if (!record.block) return std::nullopt;
  const Interval at = record.block->interval.value_or(Interval{record.block->value, record.block->value});
  const double most = std::max(std::abs(at.low), std::abs(at.high));
  return SeenBias{excludes_zero(at) || most >= 1 ? std::abs(record.block->value) : most, true};
}

std::string bias_text(const SeenBias& bias) {
  return bias.of_block ? fmt::format("{} of a block's light", percent(bias.size)) : percent(bias.size);
}

std::string sentence_of(const CorrectnessRecord& record) {
  return record.sentence + (record.regression_only.empty() ? "" : "; regression only: " + record.regression_only);
}

std::span<const VerdictWord> verdict_words() {
  static constexpr VerdictWord words[] = {
      {"right", "agrees with the reference, and an error would show",
       "The images agree with the reference, and so large an error of the whole image would have been seen "
       "(probability "
       "0.99)."},
      {"noisy", "no error seen, but noise could hide one",
       "Nothing is seen, but more than 2 % of the image or 20 % of a block of 8 × 8 pixels could hide."},
      {"biased", "differs beyond noise, by the size given",
       "The images differ from the reference by more than noise explains (by chance in 1 of 1000)."},
      {"unknown", "one seed only, or no reference to believe",
       "There is one seed only, so that noise is not known, or no reference to believe."}};
  return words;
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

const char* verdict_class(const CorrectnessRecord& record) {
  if (record.verdict == Correctness::right) return "good";
  if (record.verdict != Correctness::biased) return "open";
  const auto size = [](const std::optional<Estimate>& bias) { return bias ? std::abs(bias->value) : 0.0; };
  const bool known = record.whole || record.block;
  return known && std::max(size(record.whole), size(record.block)) <= small_bias ? "open" : "poor";
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

std::vector<std::string> verdict_notes(const View& view) {
  std::vector<std::string> notes;
  for (const SceneView& scene : view.scenes)
    for (const Convergence* curve : scene.curves)
      for (const std::string& caveat : curve->caveats)
        if (caveat.starts_with(declared_by_engine))
          notes.push_back(fmt::format("{}, {}: {}", scene.record.name, curve->engine, caveat));
  for (const SceneView& scene : view.scenes)
    if (const std::string doubt = doubt_text(scene); !doubt.empty()) notes.push_back(scene.record.name + ": " + doubt);
  return notes;
}

}  // namespace photonproof::reports::inline reports_view
