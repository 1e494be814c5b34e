#include "reports/formats/formats.h"

#include <gtest/gtest.h>

#include <set>

#include "scenes/base/input_error.h"

namespace photonproof::inline reports_formats {
namespace {

TEST(Formats, names_and_extensions_are_unique) {
  std::set<std::string_view> names, extensions;
  for (const ReportFormat& format : report_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_TRUE(extensions.insert(format.extension).second) << format.extension;
    EXPECT_EQ(&report_format(format.name), &format);
  }
  EXPECT_EQ(report_format("html").extension, ".html");
}

TEST(Formats, an_unknown_one_names_those_there_are) {
  try {
    report_format("word");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.summary(),
              "word: error: no such report format; there are html, markdown, csv, csv-wide, latex, "
              "pgfplots, svg, pdf, figure, junit, gbench, bencher");
  }
}

}  // namespace
}  // namespace photonproof::inline reports_formats
