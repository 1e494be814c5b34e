// Formats for papers: tables in LaTeX, plots and figures. Each function replaces `out` as a whole, and throws
// InputError when it cannot be written or an option does not fit the record.
#pragma once

#include <filesystem>

#include "reports/paper/paper_options.h"
#include "reports/record/results.h"

namespace photonproof::inline reports_paper {

/// LaTeX tables for \input, which need the package booktabs and fit one column (latex_table.h). Reads the options
/// `methods` and `tables`.
void write_latex_report(const Results& results, const std::filesystem::path& results_folder,
                        const std::filesystem::path& out, const PaperOptions& options);

/// A tikzpicture for each scene, for \input, which needs the package pgfplots. Reads the option `scene`.
void write_pgfplots_report(const Results& results, const std::filesystem::path& results_folder,
                           const std::filesystem::path& out, const PaperOptions& options);

/// Plots of error against time as one drawing, a panel for each scene. Reads the option `scene`.
void write_svg_report(const Results& results, const std::filesystem::path& results_folder,
                      const std::filesystem::path& out, const PaperOptions& options);
void write_pdf_report(const Results& results, const std::filesystem::path& results_folder,
                      const std::filesystem::path& out, const PaperOptions& options);

/// Crops of a scene's images with numbers and false colour, the reference last, as PDF, SVG or PNG by the end of `out`.
/// Reads the options `scene` and `insets`.
void write_inset_figure(const Results& results, const std::filesystem::path& results_folder,
                        const std::filesystem::path& out, const PaperOptions& options);

}  // namespace photonproof::inline reports_paper
