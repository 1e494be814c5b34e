// Conclusions of a benchmark for a terminal: which images are right, and which engine is faster to the same error.
#pragma once

#include <string>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_view {

/// A table of verdicts, a table of times to the same error, and the notes on both. The first has a row for each scene
/// and engine, the second a column for each engine, with the winner in bold. Empty tables are left out.
std::string console_conclusions(const View& view, bool colours);

}  // namespace photonproof::reports::inline reports_view
