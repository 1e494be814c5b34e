// The numbers of a record that a history keeps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/history/history_view.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_history {

/// One number of one record.
struct HistoryValue {
  reports::SeriesKey key;
  double value = 0;
  std::optional<Interval> interval{};   ///< 95 %, over seeds
  std::optional<double> calibration{};  ///< seconds of the calibration beside it, their median over seeds
  int seeds = 0;
  std::string verdict{};  ///< of a gate: "pass", "fail", "inconclusive"
};

/// The finished cells that do not serve as a reference.
std::vector<const Result*> measured_cells(const Results& results);

/// Values of each scene, engine and budget: medians of times and instructions over its finished cells, and the mean
/// relMSE. Cells that serve as a reference are left out. A gate has the value that it observed. Numbers beyond the
/// range of double are left out.
std::vector<HistoryValue> values_of(const Results& results);

}  // namespace photonproof::inline harness_history
