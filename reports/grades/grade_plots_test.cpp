#include "reports/grades/grade_plots.h"

#include <limits>

#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_grades {
namespace {

TEST(GradePlots, a_round_has_a_marker_of_each_program_and_a_bar_of_noise) {
  SceneSpeed speed;
  speed.baseline_seconds = {12, 12.5, 11.8};
  speed.seconds = {1, 1.2, 1.1};
  speed.busy = {0, 0.5, 0};
  const std::string svg = rounds_plot_svg(speed, "times <1>");
  EXPECT_EQ(count(svg, "class=\"point\""), 9u);
  EXPECT_EQ(count(svg, "round 2, the baseline: 12.5 s"), 1u);
  EXPECT_EQ(count(svg, "round 2, the submission: 1.20 s"), 1u);
  EXPECT_EQ(count(svg, "round 2: others keep 0.50 cores busy"), 1u);
  EXPECT_EQ(count(svg, "aria-label=\"times &lt;1&gt;\""), 1u);
}

TEST(GradePlots, what_a_logarithm_cannot_show_is_left_out) {
  SceneSpeed speed;
  EXPECT_EQ(rounds_plot_svg(speed, ""), "");
  speed.seconds = {0, -1, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(rounds_plot_svg(speed, ""), "");
  EXPECT_EQ(tiers_plot_svg({}, {0, {}}, ""), "");
  speed.seconds.push_back(2);
  const std::string svg = rounds_plot_svg(speed, "");
  EXPECT_EQ(count(svg, "class=\"point\""), 1u);
  EXPECT_EQ(count(svg, "nan"), 0u);
}

TEST(GradePlots, a_speed_up_stands_between_the_tiers_that_hold_it) {
  Grades grades;
  grades.speed_tiers = {{2, 20}, {8, 40}};
  const std::string svg = tiers_plot_svg(grades, {4, Interval{3.5, 4.5}}, "speed");
  EXPECT_EQ(count(svg, ">20 p<"), 1u);
  EXPECT_EQ(count(svg, ">40 p<"), 1u);
  EXPECT_EQ(count(svg, "4.00× [3.50, 4.50]"), 1u);
  EXPECT_EQ(count(svg, "class=\"intervals\""), 1u);
}

Grades class_with_points(const std::vector<double>& points) {
  Grades grades;
  grades.correctness_points = 100;
  for (const double one : points) {
    SubmissionGrade& submission = grades.submissions.emplace_back();
    submission.name = "n&" + std::to_string(grades.submissions.size());
    submission.correctness_points = one;
    submission.speed.scenes.resize(1);
    submission.speed.speedup.value = 1 + one;
  }
  return grades;
}

TEST(GradePlots, the_histogram_counts_everybody_once) {
  const std::string svg = class_points_svg(class_with_points({0, 9.9, 10, 99, 100}));
  EXPECT_EQ(count(svg, "2 with 0 to 10 points"), 1u);
  EXPECT_EQ(count(svg, "1 with 10 to 20 points"), 1u);
  EXPECT_EQ(count(svg, "0 with 20 to 30 points"), 1u);
  EXPECT_EQ(count(svg, "2 with 90 to 100 points"), 1u);
  EXPECT_EQ(class_points_svg({}), "");
}

TEST(GradePlots, the_fastest_is_on_top) {
  const std::string svg = class_speeds_svg(class_with_points({3, 30, 10}));
  EXPECT_LT(svg.find(">n&amp;2<"), svg.find(">n&amp;3<"));
  EXPECT_LT(svg.find(">n&amp;3<"), svg.find(">n&amp;1<"));
  EXPECT_EQ(class_speeds_svg({}), "");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades
