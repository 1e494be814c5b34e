#include "reports/plots/error_plot.h"

#include "reports/plots/log_axis.h"
#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_plots {
namespace {

ErrorPlot plot_of_box(const Results& results) {
  const View view = arrange(results);
  return error_plot(view, view.scenes[0]);
}

TEST(ErrorPlot, there_is_a_line_for_each_engine_and_seed) {
  Results results = sample_results();
  results.results.push_back(finished("box", "photon", {"photons", 2000}, 2, 0.06));
  const ErrorPlot plot = plot_of_box(results);
  ASSERT_EQ(plot.series.size(), 3u);  // photon seeds 1 and 2, povray seed 1
  EXPECT_EQ(plot.series[0].points.size(), 2u);
  EXPECT_EQ(plot.series[0].points[1].seconds, 4.5);
  EXPECT_EQ(plot.series[0].points[1].relmse, 0.0125);
  EXPECT_EQ(plot.series[1].points.size(), 1u);
  EXPECT_EQ(plot.series[2].engine, 1u);
}

TEST(ErrorPlot, cells_that_logarithmic_axes_cannot_show_are_counted) {
  Results results = sample_results();
  results.results.push_back(finished("box", "photon", {"photons", 7}, 1, 0.0));  // no error: log 0
  Result untimed = finished("box", "photon", {"photons", 8}, 1, 0.1);
  untimed.wall_seconds.reset();
  results.results.push_back(untimed);
  const ErrorPlot plot = plot_of_box(results);
  EXPECT_EQ(plot.left_out, 2u);  // the timeout is no finished cell
  EXPECT_EQ(plot.series[0].points.size(), 2u);
}

TEST(ErrorPlot, an_axis_holds_its_data_and_two_to_ten_ticks) {
  for (double span = 1; span < 1e30; span *= 1.7) {
    for (const double start : {1e-9, 0.037, 1.0, 870.0}) {
      const LogAxis axis = log_axis(start, start * span);
      EXPECT_LT(axis.low, start);
      EXPECT_GT(axis.high, start * span);
      EXPECT_GE(axis.high / axis.low, 4);
      EXPECT_GE(axis.ticks.size(), 2u) << start << " " << span;
      EXPECT_LE(axis.ticks.size(), 10u) << start << " " << span;
      EXPECT_GE(axis.ticks.front(), axis.low);
      EXPECT_LE(axis.ticks.back(), axis.high);
    }
  }
}

std::string svg_of(const Results& results) {
  const View view = arrange(results);
  const auto box = std::ranges::find(view.scenes, "box", [](const SceneView& scene) { return scene.record.name; });
  return error_plot_svg(error_plot(view, *box), "Error against time for box");
}

TEST(ErrorPlot, every_point_has_a_marker_and_says_its_numbers) {
  const std::string svg = svg_of(sample_results());
  EXPECT_EQ(count(svg, "class=\"point\""), 3u);  // two of photon, one of povray
  EXPECT_EQ(count(svg, "<title>photon, 20\u202F000 photons, seed 1: relMSE 0.0125 in 4.50 s</title><circle"), 1u);
  EXPECT_EQ(count(svg, "</title><rect"), 1u);
  EXPECT_EQ(count(svg, "class=\"intervals\""), 0u);
}

TEST(ErrorPlot, curves_over_seeds_are_drawn_with_intervals_and_the_target) {
  const std::string svg = svg_of(sample_conclusions());
  EXPECT_EQ(count(svg, "class=\"point\""), 2u);
  // The first point has intervals of relMSE and seconds, the second of relMSE: two ends each, with a bar and a cap per
  // end.
  const std::string bars = svg.substr(svg.find("class=\"intervals\""));
  EXPECT_EQ(count(bars.substr(0, bars.find("</g>")), "<path"), 3u * 2 * 2);
  EXPECT_EQ(count(svg, "target 0.0250"), 1u);
  EXPECT_EQ(count(svg, "3 seeds: relMSE 0.0500 [0.0400, 0.0625] in 1.25 [1.20, 1.50] s"), 1u);
}

/// The number that follows `key` at `from`.
double number_after(const std::string& text, const std::string& key, std::size_t from = 0) {
  return std::stod(text.substr(text.find(key, from) + key.size()));
}

TEST(ErrorPlot, equal_ratios_are_equal_distances) {
  Results results = sample_results();
  results.results.clear();
  for (const double factor : {1.0, 10.0, 100.0}) {
    Result cell = finished("box", "photon", {"photons", 1000 * factor}, 1, 0.5 / factor);
    cell.wall_seconds = 0.1 * factor;
    results.results.push_back(cell);
  }
  const std::string svg = svg_of(results);
  double x[3], y[3];
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    at = svg.find("class=\"point\"", at + 1);
    x[i] = number_after(svg, "translate(", at);
    y[i] = number_after(svg, " ", svg.find("translate(", at));
  }
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);  // coordinates are written to 0.1
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.11);
  EXPECT_GT(x[1], x[0]);  // more seconds are further right
  EXPECT_GT(y[1], y[0]);  // less error is further down
}

TEST(ErrorPlot, text_of_the_record_is_escaped) {
  Results results = sample_results();
  for (Result& result : results.results) {
    if (result.cell.engine == "photon") result.cell.engine = "<script>\"";
  }
  const std::string svg = svg_of(results);
  EXPECT_EQ(count(svg, "<script"), 0u);
  EXPECT_EQ(count(svg, "&lt;script&gt;&quot;"), 2u);
}

}  // namespace
}  // namespace photonproof::reports::inline reports_plots
