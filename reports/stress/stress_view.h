// Tables of a stress record, the same in terminal, page and README.
#pragma once

#include <string>
#include <vector>

#include "reports/stress/stress_record.h"

namespace photonproof::reports::inline reports_stress {

/// "15", "15, refused from 20", "9, silently wrong at 12", "all (45)".
std::string sweep_words(const StressSweep& sweep);

/// Whether a stops being right at a lower height than b. A sweep that is right to its top ends above all others.
bool ends_lower(const StressSweep& a, const StressSweep& b);

/// The engines, in the order in which they first climb.
std::vector<std::string> engines_of(const StressRecord& record);

/// Summary of one climb and engine over all features: the feature that ends lowest.
struct SweepRunSummary {
  std::string sweep_run, engine;
  std::size_t features = 0;      ///< that were climbed
  std::optional<double> lowest;  ///< all are right up to here; empty: none is at the first level
  bool to_the_top = false;       ///< every level of every feature is right
  std::string feature;           ///< the one that ends lowest
  std::size_t wrong = 0;         ///< silently wrong or crashed
};
/// Summaries of the climbs that several features have, and of all others together with `climb` "its own".
std::vector<SweepRunSummary> summaries(const StressRecord& record);

/// "412 right, 3 degraded, 10 refused, 0 silently wrong; 2 of 40 sweeps left out".
std::string stress_totals(const StressRecord& record);

/// The table for a terminal: summaries, then every sweep that is wrong or does not reach the wanted height.
std::string stress_table(const StressRecord& record);

/// The same for a Markdown page, with the words of every sweep and one column per engine.
std::string stress_markdown(const StressRecord& record);

/// A single self-contained file; pictures are read from `folder`.
void write_stress_page(const StressRecord& record, const std::vector<std::string>& worse,
                       const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace photonproof::reports::inline reports_stress
