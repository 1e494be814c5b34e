// The record in formats that other programs read. Each function replaces `out` as a whole and throws InputError when it
// cannot be written; none looks at the pictures.
#pragma once

#include <filesystem>

#include "reports/record/results.h"

namespace photonproof::inline reports_formats {

/// RFC 4180, one number a row: of cells, convergence, gates and changes (csv_report.cpp has the columns).
void write_csv_report(const Results& results, const std::filesystem::path& results_folder,
                      const std::filesystem::path& out);

/// LaTeX tables for \input, made with the package booktabs.
void write_latex_report(const Results& results, const std::filesystem::path& results_folder,
                        const std::filesystem::path& out);

/// JUnit XML as Jenkins' junit-10.xsd has it: a testsuite a scene, a testcase a gate, change or cell.
void write_junit_report(const Results& results, const std::filesystem::path& results_folder,
                        const std::filesystem::path& out);

/// Google Benchmark's JSON, schema version 1, for its compare.py: a finished cell is a run, a seed a repetition.
void write_gbench_report(const Results& results, const std::filesystem::path& results_folder,
                         const std::filesystem::path& out);

/// Bencher Metric Format: {"benchmark": {"measure": {"value", "lower_value", "upper_value"}}}.
void write_bencher_report(const Results& results, const std::filesystem::path& results_folder,
                          const std::filesystem::path& out);

}  // namespace photonproof::inline reports_formats
