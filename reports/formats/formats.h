// The report formats. Each has a file with a writer and a row in the table in formats.cpp.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "reports/paper/paper_options.h"
#include "reports/record/results.h"

namespace photonproof::inline reports_formats {

struct ReportFormat {
  /// Writes `out` as a whole; pictures named by the record are relative to `results_folder`. Throws InputError.
  using Writer = void (*)(const Results& results, const std::filesystem::path& results_folder,
                          const std::filesystem::path& out, const PaperOptions& options);

  std::string_view name;       ///< as given to --format
  std::string_view extension;  ///< with the dot
  Writer writer;
  std::string_view options{};  ///< Options that it reads, between spaces: " --methods --table ".

  void write(const Results& results, const std::filesystem::path& results_folder, const std::filesystem::path& out,
             const PaperOptions& paper = {}) const {
    writer(results, results_folder, out, paper);
  }
};

std::span<const ReportFormat> report_formats();

/// Throws InputError listing the formats.
const ReportFormat& report_format(std::string_view name);

}  // namespace photonproof::inline reports_formats
