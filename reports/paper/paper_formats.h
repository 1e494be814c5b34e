// Formats for papers: tables in LaTeX, plots and figures. Each function replaces `out` as a whole, and throws InputError
// when it cannot be written or an option does not fit the record.
#pragma once

#include <filesystem>

#include "reports/paper/paper_options.h"
#include "reports/record/results.h"

namespace photonproof::inline reports_paper {

/// LaTeX tables for \input, which need the package booktabs and fit one column (latex_table.h). Reads the options
/// `methods` and `tables`.
void write_latex_report(const Results& results, const std::filesystem::path& results_folder,
                        const std::filesystem::path& out, const PaperOptions& options);

}  // namespace photonproof::inline reports_paper
