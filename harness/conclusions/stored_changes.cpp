#include "harness/conclusions/stored_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/conclusions/convergence.h"
#include "harness/statistics/statistics.h"

namespace photonproof::inline harness_conclusions {
namespace {

constexpr const char* remedy = "; --old-program PATH would decide it";

// Finished cells of one scene, engine and budget.
std::vector<const Result*> cells_like(const Results& run, const Cell& cell) {
  std::vector<const Result*> cells;
  for (const Result& result : run.results)
    if (result.status == Status::ok && result.cell.scene == cell.scene && result.cell.engine == cell.engine &&
        result.cell.budget == cell.budget)
      cells.push_back(&result);
  return cells;
}

// Identifies the reference that a scene's cells were compared with; empty when there is none.
std::string reference_named(const Results& run, const std::string& scene_name) {
  for (const SceneRecord& scene : run.scenes) {
    if (scene.name != scene_name) continue;
    if (scene.reference) {
      std::string text = "stored";
      for (const auto& [name, value] : scene.reference->provenance) text += "\n" + name + "=" + value;
      return text;
    }
    const Result* reference = run.find(scene.reference_label);
    return reference == nullptr ? "" : reference->key;
  }
  return {};
}

ChangeRecord blank_record(const Cell& cell, const char* quantity) {
  ChangeRecord record;
  record.scene = cell.scene;
  record.engine = cell.engine;
  record.budget = cell.budget;
  record.quantity = quantity;
  record.ratio.value = 1;
  return record;
}

std::string verdict_words(Change change) {
  switch (change) {
    case Change::regression:
      return "worse";
    case Change::improvement:
      return "better";
    case Change::unchanged:
      return "unchanged";
    case Change::inconclusive:
      break;
  }
  return "cannot tell";
}

// Logarithms of the cells' processor times, and of their ratios to the calibration beside each. The ratios are empty
// unless every cell has a calibration of the same workload. Seeds of one kind of cell share no reading, so the ratios'
// scatter includes the readings' noise.
struct StoredTimes {
  std::vector<double> plain, calibrated;
  std::string workload;
};

StoredTimes times_of(const Results& run, const Cell& cell) {
  StoredTimes times;
  std::set<std::string> workloads;
  for (const Result* result : cells_like(run, cell)) {
    if (!result->cpu_seconds || *result->cpu_seconds <= 0) continue;
    times.plain.push_back(std::log(*result->cpu_seconds));
    if (const auto& reading = result->calibration) {
      times.calibrated.push_back(std::log(*result->cpu_seconds / reading->seconds));
      workloads.insert(fmt::format("{}, threads {}", reading->workload, reading->threads));
    }
  }
  if (workloads.size() == 1) times.workload = *workloads.begin();
  if (workloads.size() != 1 || times.calibrated.size() != times.plain.size()) times.calibrated.clear();
  return times;
}

std::string why_not_calibrated(const StoredTimes& old_times, const StoredTimes& new_times) {
  if (old_times.calibrated.empty()) return "the old run has no calibration";
  if (new_times.calibrated.empty()) return "this run has no calibration";
  return "the old run's calibration was another (" + old_times.workload + ")";
}

ChangeRecord change_of_seconds(const Results& old_run, const Results& new_run, const Cell& cell,
                               const ChangeThresholds& thresholds) {
  ChangeRecord record = blank_record(cell, "seconds");
  const StoredTimes old_times = times_of(old_run, cell), new_times = times_of(new_run, cell);
  if (old_times.plain.empty() || new_times.plain.empty()) {
    record.sentence = "cannot tell whether it is slower: one of the runs has no finished cell";
    return record;
  }
  const bool calibrated =
      !old_times.calibrated.empty() && !new_times.calibrated.empty() && old_times.workload == new_times.workload;
  const std::vector<double>& was = calibrated ? old_times.calibrated : old_times.plain;
  const std::vector<double>& is = calibrated ? new_times.calibrated : new_times.plain;
  record.ratio.value = std::exp(median_of(is) - median_of(was));
  if (old_run.host.cpu != new_run.host.cpu || old_run.host.cores != new_run.host.cores) {
    record.sentence =
        "cannot tell whether it is slower: the old run was made on another machine (" + old_run.host.cpu + ")" + remedy;
    return record;
  }
  const Estimate before = estimated_median(was), after = estimated_median(is);
  if (!before.interval || !after.interval) {
    record.sentence = fmt::format("cannot tell whether it is slower: {} and {} seeds are too few for an interval{}",
                                  was.size(), is.size(), remedy);
    return record;
  }
  const double widening = calibrated ? between_calibrated_sessions : between_sessions, noise = std::log(widening);
  record.ratio.interval = Interval{std::exp(after.interval->low - before.interval->high - noise),
                                   std::exp(after.interval->high - before.interval->low + noise)};
  record.change = side_of(*record.ratio.interval, thresholds.seconds);
  record.sentence = fmt::format(
      "{}: stored processor times new/old{} {}, widened by {:.0f} % for the change of session{}{}",
      verdict_words(record.change), calibrated ? ", each by its calibration," : "", ratio_text(record.ratio),
      100 * (widening - 1), calibrated ? "" : ", as " + why_not_calibrated(old_times, new_times),
      record.change == Change::inconclusive ? remedy : "");
  return record;
}

std::optional<ChangeRecord> change_of_relmse(const Results& old_run, const Results& new_run, const Cell& cell,
                                             const ChangeThresholds& thresholds) {
  const std::string reference = reference_named(old_run, cell.scene);
  if (reference.empty() || reference != reference_named(new_run, cell.scene)) return std::nullopt;
  std::vector<PairedRound> pairs;
  for (const Result* now : cells_like(new_run, cell)) {
    const Result* before = old_run.find(now->cell.label());
    if (before == nullptr || !relmse_of(*before) || !relmse_of(*now)) continue;
    PairedRound pair;
    pair.old_relmse = relmse_of(*before);
    pair.new_relmse = relmse_of(*now);
    pair.same_image = *pair.old_relmse == *pair.new_relmse;
    pairs.push_back(pair);
  }
  const std::optional<RatioVerdict> verdict = judge_relmse(pairs, thresholds);
  if (!verdict) return std::nullopt;
  ChangeRecord record = blank_record(cell, "relmse");
  record.ratio = verdict->ratio;
  record.change = verdict->change;
  record.sentence =
      fmt::format("{}: stored relmse new/old {}, {} seeds{}{}", verdict_words(record.change), ratio_text(record.ratio),
                  pairs.size(), verdict->reason.empty() ? "" : "; ", verdict->reason);
  return record;
}

}  // namespace

std::vector<ChangeRecord> stored_changes(const Results& old_run, const Results& new_run, const Cell& cell,
                                         const ChangeThresholds& thresholds) {
  std::vector<ChangeRecord> records;
  if (cell.budget.kind != "seconds") records.push_back(change_of_seconds(old_run, new_run, cell, thresholds));
  if (auto relmse = change_of_relmse(old_run, new_run, cell, thresholds)) records.push_back(std::move(*relmse));
  return records;
}

}  // namespace photonproof::inline harness_conclusions
