// The report as one HTML file that needs nothing else: pictures, styles and plots are inside, there is no script, and
// it refers to no other address.
#pragma once

#include <filesystem>

#include "harness/results.h"

namespace photonproof {

/// Pictures are read from `results_folder`; `out` is replaced as a whole. Missing pictures and a missing gnuplot are
/// said on the page. Throws InputError when `out` cannot be written.
void write_html_report(const Results& results, const std::filesystem::path& results_folder,
                       const std::filesystem::path& out);

}  // namespace photonproof
