// A stress record as tables: what stands in terminal, page and README alike.
#pragma once

#include <string>
#include <vector>

#include "reports/stress/stress_record.h"

namespace photonproof::reports::inline reports_stress {

/// "15", "15, refused from 20", "9, silently wrong at 12", "all (45)".
std::string sweep_words(const StressSweep& sweep);

/// Whether a stops being right at a lower height than b. One that is right to its top ends above all that are not.
bool ends_lower(const StressSweep& a, const StressSweep& b);

/// The engines, in the order in which they first climb.
std::vector<std::string> engines_of(const StressRecord& record);

/// Of one climb and engine, over all features: the one that ends lowest.
struct SweepRunSummary {
  std::string sweep_run, engine;
  std::size_t features = 0;      ///< that were climbed
  std::optional<double> lowest;  ///< up to where all are right; empty: none is at the first level
  bool to_the_top = false;       ///< every level of every feature is right
  std::string feature;           ///< the one that ends lowest
  std::size_t wrong = 0;         ///< silently wrong or crashed
};
/// Of the climbs that several features have, and of all others together where `climb` is "its own".
std::vector<SweepRunSummary> summaries(const StressRecord& record);

/// "412 right, 3 degraded, 10 refused, 0 silently wrong; 2 of 40 climbs left out".
std::string stress_totals(const StressRecord& record);

/// The table for a terminal: summaries, then every sweep that is wrong or does not reach what is wanted.
std::string stress_table(const StressRecord& record);

/// The same for a page of Markdown, with every sweep's words, an engine a column.
std::string stress_markdown(const StressRecord& record);

/// One file that needs no other; pictures are read from `folder`.
void write_stress_page(const StressRecord& record, const std::vector<std::string>& worse,
                       const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace photonproof::reports::inline reports_stress
