#include "reports/formats/markdown_report.h"

#include <sstream>

#include "reports/view/test_sample_results.h"

namespace photonproof::inline reports_formats {
namespace {

using namespace reports;
namespace fs = std::filesystem;

std::string markdown_of(const Results& results) {
  const TemporaryFolder folder;
  write_markdown_report(results, folder.path(), folder.path() / "report.md");
  return file_text(folder.path() / "report.md");
}

TEST(MarkdownReport, reads_like_its_snapshot) { expect_snapshot("sample.md", markdown_of(sample_results())); }

TEST(MarkdownReport, conclusions_read_like_their_snapshot) {
  expect_snapshot("conclusions.md", markdown_of(sample_conclusions()));
}

TEST(MarkdownReport, links_lead_from_the_report_to_the_results) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "docs");
  write_markdown_report(sample_results(), folder.path() / "out" / "run 1", folder.path() / "docs" / "report.md");
  EXPECT_EQ(count(file_text(folder.path() / "docs" / "report.md"), "](../out/run%201/box.png)"), 1u);
}

/// Vertical bars that divide cells: those not behind a backslash.
std::size_t dividers(const std::string& line) { return count(line, "|") - count(line, "\\|"); }

TEST(MarkdownReport, text_of_the_record_neither_breaks_a_table_nor_is_markup) {
  Results results = sample_results();
  const std::string evil = "a|b\n| c | <script> `x` *y*";
  results.suite = results.engines[1].title = evil;
  for (Result& result : results.results) {
    result.cell.budget.kind = evil;
    result.detail = evil;
    result.caveats = {evil};
    result.pictures = {{"image", evil}};
  }
  results.command = "run ```` me";
  std::istringstream lines(markdown_of(results));
  std::size_t expected = 0, tables = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] != '|') {
      expected = 0;
      continue;
    }
    if (expected == 0) ++tables;
    if (expected == 0) expected = dividers(line);
    EXPECT_EQ(dividers(line), expected) << line;
  }
  EXPECT_EQ(tables, 6u);  // engines, summary, and pictures and measurements of two scenes
  const std::string markdown = markdown_of(results);
  EXPECT_EQ(count(markdown, "<script>"), 0u);
  EXPECT_EQ(count(markdown, "\n`````sh\nrun ```` me\n`````\n"), 1u);  // a fence longer than any within
}

TEST(MarkdownReport, runs_without_finished_cells_or_scenes_are_reported) {
  Results results = sample_results();
  for (Result& result : results.results) result.status = Status::bad_image;
  EXPECT_EQ(count(markdown_of(results), "6 images: 0 finished, 6 did not"), 1u);
  EXPECT_EQ(count(markdown_of(Results{}), "0 scenes, 0 engines, 0 images"), 1u);
}

}  // namespace
}  // namespace photonproof::inline reports_formats
