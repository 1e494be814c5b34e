// Details of a cell beyond its row of the table, the same in both formats.
#pragma once

#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_view {

struct Detail {
  std::string term;                ///< "phases"
  std::vector<std::string> texts;  ///< one or more lines
};

/// Phases, counts, skipped passes, metrics without a column, the engine's version and the image, as far as they exist.
/// Texts come from the record and are not escaped.
std::vector<Detail> cell_details(const Result& result);

/// Command that computes the cell's metrics again in the results folder: "photonproof compare a.exr b.exr --exposure
/// 0". Empty if one of the images is not kept.
std::string compare_command(const SceneView& scene, const Result& result);

/// The reason why the cell is not ok; empty when it is.
std::string reason_text(const Result& result);

/// The warnings on a cell's numbers in one line; empty when there are none.
std::string caveats_text(const Result& result);

/// Summary of how an engine's cells on one scene ended: "6 finished", "2 of 6 timeout", "3 of 6 not finished", "not
/// run".
std::string state_text(const EngineOutcome& outcome);

}  // namespace photonproof::reports::inline reports_view
