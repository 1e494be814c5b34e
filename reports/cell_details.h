// What a cell has to tell beyond its row of the table, as both formats print it.
#pragma once

#include <string>
#include <vector>

#include "reports/view.h"

namespace photonproof::reports {

struct Detail {
  std::string term;                ///< "phases"
  std::vector<std::string> texts;  ///< one or more lines
};

/// Phases, counts, skipped passes, metrics without a column, the engine's version and the image, as far as there are
/// any. Texts come from the record and are not escaped.
std::vector<Detail> cell_details(const Result& result);

/// The remarks that belong right below a cell's row: the reason when it is not ok, and its caveats.
std::vector<std::string> cell_remarks(const Result& result);

/// How an engine's cells on one scene ended, in few words: "6 ok", "2 of 6 timeout", "3 of 6 not ok", "not run".
std::string state_text(const EngineOutcome& outcome);

}  // namespace photonproof::reports
