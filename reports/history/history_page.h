// The page of a history: the last step in a sentence, a table of steps, and plots of every series over commits.
#pragma once

#include <filesystem>

#include "reports/history/history_view.h"

namespace photonproof::reports::inline reports_history {

/// Replaces `out` as a whole; the page needs no other file. `name` is that of the history's file. Throws InputError
/// when it cannot be written. Precondition: at least one series.
void write_history_page(const History& history, const std::string& name, const std::filesystem::path& out);

}  // namespace photonproof::reports::inline reports_history
