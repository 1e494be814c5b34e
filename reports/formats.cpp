#include "reports/formats.h"

#include <string>

#include "reports/html_report.h"
#include "reports/markdown_report.h"
#include "scenes/input_error.h"

namespace photonproof {

std::span<const ReportFormat> report_formats() {
  static constexpr ReportFormat formats[] = {
      {"html", ".html", write_html_report},
      {"markdown", ".md", write_markdown_report},
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

}  // namespace photonproof
