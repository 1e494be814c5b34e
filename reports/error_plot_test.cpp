#include "reports/error_plot.h"

#include "reports/gnuplot.h"
#include "reports/sample_results.h"

namespace photonproof::reports {
namespace {

TEST(ErrorPlot, there_is_a_line_for_each_engine_and_seed) {
  Results results = sample_results();
  results.results.push_back(finished("box", "photon", {"photons", 2000}, 2, 0.06));
  const ErrorPlot plot = error_plot(arrange(results).scenes[0]);
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
  const ErrorPlot plot = error_plot(arrange(results).scenes[0]);
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

TEST(ErrorPlot, the_script_holds_no_text_of_the_record) {
  Results results = sample_results();
  results.engines[0].name = "`touch x`";
  for (Result& result : results.results) {
    if (result.cell.engine == "photon") result.cell.engine = "`touch x`";
  }
  const std::string script = gnuplot_script(error_plot(arrange(results).scenes[0]));
  EXPECT_EQ(script.find("touch"), std::string::npos);
  EXPECT_NE(script.find("4.5 0.012500000000000001"), std::string::npos);  // 0.0125 to 17 digits
}

TEST(ErrorPlot, gnuplot_draws_every_point) {
  const Results results = sample_results();
  const PlotOutcome drawn = run_gnuplot(gnuplot_script(error_plot(arrange(results).scenes[0])));
  ASSERT_EQ(drawn.problem, "");
  const std::string svg = inline_svg(drawn.svg, "scene-1-", "role=\"img\"");
  // Markers are references to shapes: two of photon (a filled circle) and one of povray (a filled square).
  EXPECT_EQ(count(svg, "<use href='#scene-1-gpPt6' transform='translate"), 2u);
  EXPECT_EQ(count(svg, "<use href='#scene-1-gpPt4' transform='translate"), 1u);
}

TEST(Gnuplot, a_missing_program_is_said) {
  const PlotOutcome outcome = run_gnuplot("plot x", "no-such-gnuplot");
  EXPECT_EQ(outcome.svg, "");
  EXPECT_EQ(outcome.problem, "no-such-gnuplot is not installed");
}

TEST(Gnuplot, a_faulty_script_is_said) {
  const PlotOutcome outcome = run_gnuplot("set terminal svg\nplott x\n");
  EXPECT_EQ(outcome.svg, "");
  EXPECT_EQ(outcome.problem.rfind("gnuplot failed: ", 0), 0u) << outcome.problem;
  EXPECT_NE(outcome.problem.find("plott"), std::string::npos) << outcome.problem;
}

TEST(Gnuplot, a_drawing_that_is_not_gnuplots_is_refused) { EXPECT_EQ(inline_svg("<svg></svg>", "a-", ""), ""); }

TEST(Gnuplot, an_inlined_drawing_has_its_own_ids_and_no_tooltips) {
  const PlotOutcome drawn = run_gnuplot("set terminal svg size 100,100\nplot x title 'line'\n");
  const std::string svg = inline_svg(drawn.svg, "k-", "class=\"c\"");
  EXPECT_EQ(svg.rfind("<svg viewBox=\"0 0 100 100\" class=\"c\">", 0), 0u) << svg.substr(0, 80);
  EXPECT_EQ(count(svg, "<title>"), 0u);
  EXPECT_EQ(count(svg, "http"), 0u);
  EXPECT_EQ(count(svg, "id="), count(svg, "id='k-") + count(svg, "id=\"k-"));
  EXPECT_EQ(svg.substr(svg.size() - 6), "</svg>");
}

}  // namespace
}  // namespace photonproof::reports
