#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "reports/paper/latex_table.h"
#include "reports/paper/paper_formats.h"
#include "reports/view/test_hostile_results.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_paper {
namespace {

using namespace reports;

std::string written(const Results& results, const PaperOptions& options = {}) {
  const TemporaryFolder folder;
  write_latex_report(results, folder.path(), folder.path() / "out", options);
  return file_text(folder.path() / "out");
}

TEST(LatexReport, reads_like_its_snapshot) { expect_snapshot("sample.tex", written(sample_conclusions())); }

/// Occurrences of `what` after an even number of backslashes.
std::size_t unescaped(const std::string& text, char what) {
  std::size_t n = 0;
  bool escaped = false;
  for (const char c : text) {
    if (c == what && !escaped) ++n;
    escaped = c == '\\' && !escaped;
  }
  return n;
}

TEST(LatexReport, rows_are_whole_and_text_of_the_record_is_no_command) {
  const std::string text = written(hostile("\\input{x} $a_b^c$ 100% #1 & ~ } \\"));
  EXPECT_EQ(count(text, "\\input"), 3u);  // inside the comments at the top, where it does nothing
  EXPECT_EQ(count(text, "\\textbackslash{}input\\{x\\}"), count(text, "textbackslash{}input"));
  std::istringstream lines(text);
  std::string line;
  std::size_t columns = 0, rows = 0;
  while (std::getline(lines, line)) {
    if (line.rfind('%', 0) == 0) continue;
    EXPECT_EQ(unescaped(line, '{'), unescaped(line, '}')) << line;
    EXPECT_EQ(unescaped(line, '$') % 2, 0u) << line;
    EXPECT_EQ(unescaped(line, '#') + unescaped(line, '%') + unescaped(line, '~'), 0u) << line;
    std::smatch match;
    if (std::regex_search(line, match, std::regex(R"(begin\{tabular\}\{@\{\}([lr]+)@\{\}\})")))
      columns = match[1].length();
    if (!line.ends_with(" \\\\")) continue;
    const bool heading = line.starts_with("  \\multicolumn{" + std::to_string(columns) + "}");
    EXPECT_EQ(unescaped(line, '&'), heading ? 0 : columns - 1) << line;
    ++rows;
  }
  // Seven tables in at least one part, each with a head, a heading of a scene and a row.
  EXPECT_GE(rows, 7u * 3u);
}

TEST(LatexReport, is_ascii_and_loses_no_symbol) {
  const std::string text = written(hostile(symbols));
  const auto other = std::ranges::find_if(text, [](unsigned char c) { return c >= 0x80; });
  EXPECT_EQ(other, text.end()) << text.substr(static_cast<std::size_t>(other - text.begin()), 20);
  for (const char* set : {"$\\leq$", "$\\approx$", "$\\neq$", "$\\dagger$", "\\'{e}", "[U+4E2D][U+6587]", "[U+2713]"})
    EXPECT_GT(count(text, set), 0u) << set;
}

TEST(LatexReport, a_scene_is_called_by_its_title_where_the_record_has_one) {
  Results results = sample_conclusions();
  EXPECT_EQ(count(written(results), "A 100\\% white box"), 0u);
  results.scenes[0].title = "A 100% white box";
  EXPECT_GE(count(written(results), "A 100\\% white box"), 3u);
  EXPECT_EQ(count(written(results), "Box"), 0u);
}

TEST(LatexReport, time_that_is_only_a_bound_stays_one) {
  Results results = sample_conclusions();
  for (Convergence& curve : results.convergence)
    for (TargetTime& target : curve.targets) {
      target = {};
      target.relmse = 0.01;
      target.at_most = 0.5;
    }
  EXPECT_GT(count(written(results), " & $\\leq$ 0.500 \\\\"), 0u);
}

TEST(LatexReport, header_names_the_clock_of_its_times) {
  Results results = sample_conclusions();
  const std::string by_wall = written(results);
  EXPECT_EQ(count(by_wall, "& Median wall s "), 1u);
  EXPECT_EQ(count(by_wall, "& s to target"), 1u);
  for (Convergence& curve : results.convergence) curve.clock = Clock::processor;
  const std::string by_processor = written(results);
  EXPECT_EQ(count(by_processor, "& Median CPU s "), 1u);
  EXPECT_EQ(count(by_processor, "& CPU s to target"), 1u);
  EXPECT_EQ(count(by_processor, "Median wall"), 0u);
}

TEST(LatexReport, caption_has_the_title_and_the_label_the_name) {
  Results results = sample_conclusions();
  results.title = "A title of its own";
  const std::string text = written(results);
  EXPECT_GT(count(text, "\\caption{A title of its own: "), 1u);
  EXPECT_GT(count(text, "\\label{tab:sample-"), 1u);
}

// "\\\\" and \midrule take what is in brackets, and "\\\\" a star, for their own argument.
TEST(LatexReport, cell_that_begins_with_a_bracket_or_a_star_is_text) {
  for (const char* name : {"[box]", "*box"}) {
    Results results = sample_conclusions();
    for (Convergence& curve : results.convergence) curve.engine = name;
    const std::string text = written(results);
    EXPECT_EQ(count(text, "\n  " + std::string(1, name[0])), 0u) << text;
    EXPECT_GT(count(text, "\n  {" + std::string(1, name[0]) + "}"), 0u);
  }
}

TEST(LatexReport, methods_are_columns_of_a_table_for_each_quantity) {
  PaperOptions options;
  options.methods = MethodsSide::columns;
  const std::string text = written(sample_conclusions(), options);
  const std::size_t at = text.find("\\label{tab:sample-errors-relMSE}");
  ASSERT_NE(at, std::string::npos);
  const std::string table = text.substr(at, text.find("\\end{table}", at) - at);
  EXPECT_EQ(count(table, "  Scene & Photon mapper & POV-Ray \\\\\n"), 1u) << table;
  EXPECT_EQ(count(table, "  Box & 0.0125 & 0.250 \\\\\n"), 1u) << table;
  EXPECT_EQ(count(table, "  Hole & -- & -- \\\\\n"), 1u) << table;
}

TEST(LatexReport, races_say_time_and_ratio_and_the_best_is_bold_only_beyond_noise) {
  Results results = sample_conclusions();
  results.results.push_back(finished("box", "path", {"spp", 4}, 1, 0.2));
  const std::string won = written(results, {.tables = {"races"}});
  EXPECT_EQ(count(won, "\\textbf{1.2 s} & "), 1u) << won;
  EXPECT_EQ(count(won, "  Path & 12 s & 9.0 to 11 times "), 1u) << won;
  EXPECT_EQ(count(won, "Times are wall-clock seconds."), 1u);
  EXPECT_EQ(count(won, "\\begin{table}"), 1u);
  results.races[0].times[1].ratio->interval = Interval{0.9, 11};
  EXPECT_EQ(count(written(results, {.tables = {"races"}}), "\\textbf"), 0u);
  for (Convergence& curve : results.convergence) curve.clock = Clock::processor;
  EXPECT_EQ(count(written(results, {.tables = {"races"}}), "Times are processor seconds of all threads."), 1u);
}

TEST(LatexReport, unknown_table_names_those_there_are_and_nothing_is_written) {
  const TemporaryFolder folder;
  try {
    write_latex_report(sample_conclusions(), folder.path(), folder.path() / "out", {.tables = {"speed"}});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.summary(),
              "--table: error: no such table: speed; there are races, equal-time, errors, points, slopes, gates");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(LatexReport, two_engines_of_one_title_have_their_names) {
  Results results = sample_conclusions();
  for (EngineRecord& engine : results.engines) engine.title = "renderer";
  EXPECT_EQ(count(written(results), "Renderer"), 0u);
  EXPECT_GT(count(written(results), "  povray & "), 0u);
}

// Widths of cmr8 at 8 pt by TeX itself: \settowidth gives 0.53126 em a digit, 0.79687 em for A and 0.3542 em a space.
TEST(LatexTable, width_is_that_of_computer_modern) {
  EXPECT_NEAR(latex_width("0123"), 4 * 0.53126 * 8, 0.1);
  EXPECT_NEAR(latex_width("A A"), (2 * 0.79687 + 0.3542) * 8, 0.1);
  EXPECT_NEAR(latex_width("\u00b1"), 0.85 * 8, 0.1);
}

}  // namespace
}  // namespace photonproof::inline reports_paper
