#include "reports/paper/paper_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "reports/paper/paper_formats.h"
#include "reports/view/test_hostile_results.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_paper {
namespace {

using namespace reports;

PlotSeries series_of(const std::vector<std::array<double, 2>>& points, std::optional<double> slope) {
  PlotSeries series;
  for (const auto& [seconds, relmse] : points) series.points.push_back({seconds, relmse});
  series.slope = slope;
  return series;
}

// log10 of the errors at 1, 10 and 100 s: 0, -2, -3. Least squares: slope -1.5, mean -5/3 at 10 s, so -1/6 and -19/6 at
// the ends.
TEST(PaperPlot, fitted_line_is_that_of_least_squares) {
  const auto line = fitted_line(series_of({{1, 1}, {10, 0.01}, {100, 0.001}}, -1.5));
  ASSERT_TRUE(line);
  EXPECT_EQ(line->seconds[0], 1);
  EXPECT_EQ(line->seconds[1], 100);
  EXPECT_NEAR(std::log10(line->relmse[0]), -1.0 / 6, 1e-12);
  EXPECT_NEAR(std::log10(line->relmse[1]), -19.0 / 6, 1e-12);
}

TEST(PaperPlot, there_is_no_fitted_line_without_a_slope_or_a_second_point) {
  EXPECT_FALSE(fitted_line(series_of({{1, 1}, {10, 0.01}}, std::nullopt)));
  EXPECT_FALSE(fitted_line(series_of({{1, 1}}, -1)));
}

TEST(PaperPlot, band_goes_around_the_intervals_and_ends_where_there_is_none) {
  PlotSeries series = series_of({{1, 1}, {2, 0.5}, {4, 0.25}, {8, 0.125}}, {});
  for (const std::size_t i : {0u, 1u, 3u}) {
    const double relmse = series.points[i].relmse;
    series.points[i].relmse_interval = Interval{relmse / 2, relmse * 2};
  }
  using Corners = std::vector<std::array<double, 2>>;
  EXPECT_EQ(interval_bands(series),
            (std::vector<Corners>{{{1, 2}, {2, 1}, {2, 0.25}, {1, 0.5}}, {{8, 0.25}, {8, 0.0625}}}));
}

// A grey print keeps marks and dashes only: the first 30 methods differ in one of them.
TEST(PaperPlot, methods_differ_without_colour) {
  std::set<std::pair<int, std::vector<double>>> styles;
  for (std::size_t engine = 0; engine < 30; ++engine) {
    const MethodStyle style = method_style(engine);
    styles.insert({style.mark, style.dash});
    EXPECT_EQ(style.color.size(), 6u);
  }
  EXPECT_EQ(styles.size(), 30u);
}

std::string pgfplots_of(const Results& results, const PaperOptions& options = {}) {
  const TemporaryFolder folder;
  write_pgfplots_report(results, folder.path(), folder.path() / "out", options);
  return file_text(folder.path() / "out");
}

TEST(PgfplotsReport, reads_like_its_snapshot) { expect_snapshot("sample.pgf.tex", pgfplots_of(sample_conclusions())); }

TEST(PgfplotsReport, has_a_picture_for_each_scene_or_the_one_asked_for) {
  Results results = sample_conclusions();
  Convergence curve = sample_curve();
  curve.scene = "hole";
  results.convergence.push_back(curve);
  EXPECT_EQ(count(pgfplots_of(results), "\\begin{tikzpicture}"), 2u);
  const std::string one = pgfplots_of(results, {.scene = "box"});
  EXPECT_EQ(count(one, "\\begin{tikzpicture}"), 1u);
  EXPECT_EQ(count(one, "title={Box}"), 1u);
}

TEST(PgfplotsReport, axis_names_the_clock) {
  Results results = sample_conclusions();
  EXPECT_EQ(count(pgfplots_of(results), "xlabel={Wall-clock time in s}"), 1u);
  for (Convergence& curve : results.convergence) curve.clock = Clock::processor;
  EXPECT_EQ(count(pgfplots_of(results), "xlabel={Processor time of all threads in s}"), 1u);
}

TEST(PgfplotsReport, text_of_the_record_is_no_command) {
  const std::string text = pgfplots_of(hostile("\\input{x} & $ } \\"));
  EXPECT_EQ(count(text, "\\input"), 3u);  // in the comments
}

TEST(PgfplotsReport, unknown_scene_names_those_there_are) {
  try {
    pgfplots_of(sample_conclusions(), {.scene = "cave"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.summary(), "--scene: error: the record has no scene cave; it has hole, box");
  }
}

}  // namespace
}  // namespace photonproof::inline reports_paper
