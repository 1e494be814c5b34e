// The report as one HTML file that needs nothing else: pictures, pixel values, styles, plots and a script are inside,
// and it refers to no other address. Without the script it still has every number and picture.
#pragma once

#include <filesystem>

#include "reports/record/results.h"

namespace photonproof::inline reports_page {

/// Pictures are read from `results_folder`; `out` is replaced as a whole. Missing pictures are said on the
/// page. Throws InputError when `out` cannot be written.
void write_html_report(const Results& results, const std::filesystem::path& results_folder,
                       const std::filesystem::path& out);

}  // namespace photonproof::inline reports_page
