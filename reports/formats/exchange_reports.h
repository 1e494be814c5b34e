// Writes the record in formats for other programs. Each function replaces `out` as a whole and throws InputError when
// it cannot be written; none reads the pictures.
#pragma once

#include <filesystem>

#include "reports/record/results.h"

namespace photonproof::inline reports_formats {

/// RFC 4180, one number per row, for cells, convergence, gates and changes (csv_report.cpp lists the columns).
void write_csv_report(const Results& results, const std::filesystem::path& results_folder,
                      const std::filesystem::path& out);

/// One row per scene, engine and budget, with a column for each number over seeds (wide_csv_report.cpp lists them).
void write_wide_csv_report(const Results& results, const std::filesystem::path& results_folder,
                           const std::filesystem::path& out);

/// JUnit XML by Jenkins' junit-10.xsd: one testsuite per scene, one testcase per gate, change or cell.
void write_junit_report(const Results& results, const std::filesystem::path& results_folder,
                        const std::filesystem::path& out);

/// Google Benchmark's JSON, schema version 1, for its compare.py: a finished cell is a run, a seed a repetition.
void write_gbench_report(const Results& results, const std::filesystem::path& results_folder,
                         const std::filesystem::path& out);

/// Bencher Metric Format: {"benchmark": {"measure": {"value", "lower_value", "upper_value"}}}.
void write_bencher_report(const Results& results, const std::filesystem::path& results_folder,
                          const std::filesystem::path& out);

}  // namespace photonproof::inline reports_formats
