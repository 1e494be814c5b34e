// The report as one self-contained HTML file with pictures, pixel values, styles, plots and a script; it refers to no
// other address. Without the script it still has every number and picture.
#pragma once

#include <filesystem>

#include "reports/record/results.h"

namespace photonproof::inline reports_page {

/// Reads pictures from `results_folder` and replaces `out` as a whole. The page names missing pictures. Throws
/// InputError when `out` cannot be written.
void write_html_report(const Results& results, const std::filesystem::path& results_folder,
                       const std::filesystem::path& out);

/// The same of a run that goes on: the page loads itself again every few seconds, and keeps its reader's place.
void write_live_html_report(const Results& results, const std::filesystem::path& results_folder,
                            const std::filesystem::path& out);

}  // namespace photonproof::inline reports_page
