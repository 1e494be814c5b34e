#include "reports/formats/formats.h"

#include <string>

#include "reports/formats/exchange_reports.h"
#include "reports/formats/markdown_report.h"
#include "reports/page/html_report.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_formats {

std::span<const ReportFormat> report_formats() {
  static constexpr ReportFormat formats[] = {
      {"html", ".html", write_html_report},
      {"markdown", ".md", write_markdown_report},
      {"csv", ".csv", write_csv_report},
      {"latex", ".tex", write_latex_report},
      {"junit", ".junit.xml", write_junit_report},
      {"gbench", ".gbench.json", write_gbench_report},
      {"bencher", ".bencher.json", write_bencher_report},
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
