// The report as one Markdown file (GitHub's dialect) that links the pictures of the results folder.
#pragma once

#include <filesystem>

#include "reports/record/results.h"

namespace photonproof::inline reports_formats {

/// Links are relative to the folder of `out`, which is replaced as a whole. Throws InputError when it cannot be
/// written.
void write_markdown_report(const Results& results, const std::filesystem::path& results_folder,
                           const std::filesystem::path& out);

}  // namespace photonproof::inline reports_formats
