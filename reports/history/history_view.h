// Measurements over commits as pages show them: series of one quantity each, with the steps found in them. It is made
// by harness/history; pages compute no statistics of their own.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::reports::inline reports_history {

/// Quantity of a series. Seconds, instructions and relmse are over one image; `gate` is the value that a gate observes.
enum class Measure { processor_seconds, wall_seconds, instructions, relmse, gate };
/// "processor seconds", "wall seconds", "instructions", "relMSE", "gate": also their names in the database.
const char* to_string(Measure measure);
std::optional<Measure> measure_named(const std::string& name);

/// Values of one key are comparable. Times and instructions depend on the machine, errors do not.
struct SeriesKey {
  std::string suite, scene, size;  ///< size: "64x64"
  std::string engine;
  std::string budget;  ///< "16 spp"; of a gate its metric or its name
  Measure measure = Measure::relmse;
  std::string machine{};  ///< "AMD EPYC, 2 cores"; empty for errors
  friend auto operator<=>(const SeriesKey&, const SeriesKey&) = default;
};

struct HistoryCommit {
  std::string name;
  std::int64_t date = 0;  ///< seconds since 1970, UTC
  friend bool operator==(const HistoryCommit&, const HistoryCommit&) = default;
};

/// The value of a series at one commit: the median of its records there.
struct HistoryPoint {
  std::size_t commit = 0;  ///< index into History::commits
  double value = 0;
  std::optional<Interval> interval{};  ///< 95 %, over seeds
  int seeds = 0;                       ///< images of the record; 0 of a gate
  std::optional<GateVerdict> verdict{};
};

/// A change from one level to another, of all points on either side up to the next step.
struct HistoryStep {
  std::size_t point = 0;  ///< first of the new level: index into HistorySeries::points
  double before = 0, after = 0;
  bool relative = true;  ///< `change` is after / before - 1, else after - before
  double change = 0;
  std::optional<Interval> interval{};  ///< of `change`, 95 %
};

struct HistorySeries {
  SeriesKey key;
  /// Steps are searched here. Wall time beside processor time is shown alone, since it follows the machine's load.
  bool is_judged = true;
  /// Seconds are those of a machine whose calibration takes its median time over the series.
  bool is_calibrated = false;
  std::vector<HistoryPoint> points;  ///< by commit, at least one
  std::vector<double> levels;        ///< one more than steps
  std::vector<HistoryStep> steps;    ///< ascending
};

struct History {
  std::vector<HistoryCommit> commits;  ///< by date, then by name
  std::vector<HistorySeries> series;   ///< by key
  std::size_t records = 0;
  std::size_t left_out = 0;  ///< values that are not finite
};

/// A step with its series.
struct NamedStep {
  const HistorySeries* series = nullptr;
  const HistoryStep* step = nullptr;
};

/// All steps: the newest commit first, then the largest.
std::vector<NamedStep> steps_of(const History& history);

}  // namespace photonproof::reports::inline reports_history
