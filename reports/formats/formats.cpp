#include "reports/formats/formats.h"

#include <string>

#include "reports/formats/exchange_reports.h"
#include "reports/formats/markdown_report.h"
#include "reports/page/html_report.h"
#include "reports/paper/paper_formats.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_formats {

namespace {

using Plain = void (*)(const Results& results, const std::filesystem::path& folder, const std::filesystem::path& out);

/// A writer without options.
template <Plain write>
void without_options(const Results& results, const std::filesystem::path& folder, const std::filesystem::path& out,
                     const PaperOptions&) {
  write(results, folder, out);
}

}  // namespace

std::span<const ReportFormat> report_formats() {
  static constexpr ReportFormat formats[] = {
      {"html", ".html", without_options<write_html_report>},
      {"markdown", ".md", without_options<write_markdown_report>},
      {"csv", ".csv", without_options<write_csv_report>},
      {"csv-wide", ".wide.csv", without_options<write_wide_csv_report>},
      {"latex", ".tex", write_latex_report, " --methods --table "},
      {"pgfplots", ".pgf.tex", write_pgfplots_report, " --scene "},
      {"svg", ".svg", write_svg_report, " --scene "},
      {"pdf", ".pdf", write_pdf_report, " --scene "},
      {"figure", ".figure.pdf", write_inset_figure, " --scene --inset "},
      {"junit", ".junit.xml", without_options<write_junit_report>},
      {"gbench", ".gbench.json", without_options<write_gbench_report>},
      {"bencher", ".bencher.json", without_options<write_bencher_report>},
  };
  return formats;
}

const ReportFormat& report_format(std::string_view name) {
  std::string known;
  for (const ReportFormat& format : report_formats()) {
    if (format.name == name) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  throw InputError(std::string(name), "no such report format; there are " + known);
}

}  // namespace photonproof::inline reports_formats
