// Sizes and intervals of steps and changes, against numbers worked out by hand.
#include "harness/history/history_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "harness/history/history_changes.h"
#include "reports/history/history_words.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_history {
namespace {

using reports::History;
using reports::HistorySeries;
using reports::Measure;

/// A history of one series with a value at each commit, named "c0", "c1" ...
History history_of(const std::vector<double>& values, Measure measure = Measure::relmse) {
  History history;
  HistorySeries series;
  series.key = {"suite", "cornell", "64x64", "photonmapper", "16 spp", measure};
  for (std::size_t i = 0; i < values.size(); ++i) {
    history.commits.push_back({"c" + std::to_string(i), static_cast<std::int64_t>(i)});
    series.points.push_back({i, values[i], {}, 3, {}});
  }
  history.series.push_back(series);
  return history;
}

std::vector<double> alternating(std::size_t count, double logarithm) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(std::exp(logarithm + (i % 2 == 0 ? 0.01 : -0.01)));
  return values;
}

std::vector<double> operator+(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Logarithms scatter by 0.01 around 0 and 0.1. The 16 squares of 1e-4 over 14 degrees of freedom are 1.142857e-4; the
// difference of two means of 8 has the standard error sqrt(1.142857e-4 / 4) = 0.0053452. With t = 2.14479 the interval
// is exp(0.1 -+ 0.0114645) - 1 = 0.09257 to 0.11791.
TEST(HistorySteps, size_and_interval_are_those_worked_out_by_hand) {
  History history = history_of(alternating(8, 0) + alternating(8, 0.1));
  find_steps(history);
  const HistorySeries& series = history.series[0];
  ASSERT_EQ(series.steps.size(), 1u);
  const reports::HistoryStep& step = series.steps[0];
  EXPECT_EQ(step.point, 8u);
  EXPECT_NEAR(step.change, std::expm1(0.1), 1e-9);
  ASSERT_TRUE(step.interval);
  EXPECT_NEAR(step.interval->low, 0.09257, 2e-5);
  EXPECT_NEAR(step.interval->high, 0.11791, 2e-5);
  EXPECT_NEAR(series.levels.at(0), 1, 1e-9);
  EXPECT_NEAR(series.levels.at(1), std::exp(0.1), 1e-9);
  EXPECT_EQ(reports::last_step_sentence(history), "relMSE of photonmapper on cornell rose 11 % [9.3, 12] at c8");
}

TEST(HistorySteps, fall_has_its_interval_in_its_direction) {
  History history = history_of(alternating(8, 0.1) + alternating(8, 0));
  find_steps(history);
  // exp(-0.1) - 1 = -9.5 %, from exp(-0.1114645) - 1 = -10.6 % to exp(-0.0885355) - 1 = -8.5 %.
  EXPECT_EQ(reports::last_step_sentence(history), "relMSE of photonmapper on cornell fell 9.5 % [8.5, 11] at c8");
  EXPECT_FALSE(reports::is_worse(history.series[0].key, history.series[0].steps.at(0)));
}

TEST(HistorySteps, repeated_value_that_changes_is_a_step_at_once) {
  History history = history_of({0.5, 0.5, 0.5, 0.5, 0.6});
  find_steps(history);
  EXPECT_EQ(reports::last_step_sentence(history), "relMSE of photonmapper on cornell rose 20 % at c4");
}

// An interval of -+12 % is one of 1.96 standard errors of 0.0615 on the logarithm. Both levels together have 0.0870,
// and 20 % is a difference of 0.182: more than two of them, less than 3.29.
TEST(HistorySteps, change_that_the_seeds_explain_is_no_step) {
  History history = history_of({0.5, 0.5, 0.5, 0.5, 0.6});
  for (reports::HistoryPoint& point : history.series[0].points)
    point.interval = Interval{point.value * 0.88, point.value * 1.12};
  find_steps(history);
  EXPECT_TRUE(history.series[0].steps.empty());
  EXPECT_EQ(history.series[0].levels.size(), 1u);
  for (reports::HistoryPoint& point : history.series[0].points)
    point.interval = Interval{point.value * 0.97, point.value * 1.03};
  history.series[0].levels.clear();
  find_steps(history);
  ASSERT_EQ(history.series[0].steps.size(), 1u);
  // Both have ln(1.03 / 0.97) / 2 = 0.030009 as half width, so the difference has 0.042439: 1.2 exp(-+0.042439) - 1.
  EXPECT_NEAR(history.series[0].steps[0].interval->low, 0.15014, 1e-4);
  EXPECT_NEAR(history.series[0].steps[0].interval->high, 0.25202, 1e-4);
}

TEST(HistorySteps, changes_below_one_percent_and_unjudged_series_have_none) {
  History small = history_of({1, 1, 1, 1, 1.009, 1.009});
  find_steps(small);
  EXPECT_TRUE(small.series[0].steps.empty());
  History shown = history_of({1, 1, 1, 1, 2, 2}, Measure::wall_seconds);
  shown.series[0].is_judged = false;
  find_steps(shown);
  EXPECT_TRUE(shown.series[0].steps.empty());
  EXPECT_EQ(reports::last_step_sentence(shown), "No step in 0 series of 6 commits");
}

TEST(HistorySteps, gate_that_observes_either_sign_moves_by_a_difference) {
  History history = history_of({-0.001, -0.001, -0.001, 0.02, 0.02}, Measure::gate);
  history.series[0].key.budget = "bias";
  find_steps(history);
  EXPECT_EQ(reports::last_step_sentence(history),
            "gate bias of photonmapper on cornell moved from −0.10 % to +2.0 % at c3");
  EXPECT_TRUE(reports::is_worse(history.series[0].key, history.series[0].steps.at(0)));
  History positive = history_of({0.001, 0.001, 0.001, 0.02, 0.02}, Measure::gate);
  positive.series[0].key.budget = "bias";
  find_steps(positive);
  EXPECT_EQ(reports::last_step_sentence(positive),
            "gate bias of photonmapper on cornell moved from +0.10 % to +2.0 % at c3");
}

TEST(HistorySteps, huge_values_stay_finite_or_are_told) {
  History history = history_of({1e308, 1e308, 1e308, 1e-308, 1e-308, 0, 1e308});
  EXPECT_NO_THROW(find_steps(history));
  EXPECT_NO_THROW(reports::last_step_sentence(history));
  History positive = history_of({1e-308, 1e-308, 1e-308, 1e308, 1e308});
  find_steps(positive);
  EXPECT_EQ(reports::last_step_sentence(positive), "relMSE of photonmapper on cornell rose to ∞ times at c3");
}

// Base level: logarithms +-0.01, so s^2 = 8e-4 / 7; a new value has s sqrt(1 + 1/8) = 0.011339. One series is tested
// at 0.01 two-sided: t(7) = 3.4995, 0.03968. A head of 4.5 % (0.0440) is beyond, one of 3.5 % (0.0344) is not.
TEST(HistoryChanges, head_is_judged_by_the_scatter_of_the_commits_before) {
  for (const auto& [value, found] : {std::pair(1.045, 1u), std::pair(1.035, 0u)}) {
    History history = history_of(alternating(8, 0) + std::vector<double>{value}, Measure::processor_seconds);
    find_steps(history);
    const reports::HistoryComparison comparison = compare_commits(history, 7, 8);
    EXPECT_EQ(comparison.compared, 1u);
    ASSERT_EQ(comparison.changes.size(), found) << value;
    if (found == 0) continue;
    EXPECT_NEAR(comparison.changes[0].step.change, 0.045, 1e-9);
    // t(7) at 0.975 is 2.36462: exp(0.0440169 - 0.0268121) - 1.
    EXPECT_NEAR(comparison.changes[0].step.interval->low, 0.017354, 1e-5);
    EXPECT_EQ(comparison.changes[0].side, reports::ChangeSide::worse);
    EXPECT_EQ(reports::comparison_sentence(comparison).substr(0, 47),
              "processor time of photonmapper on cornell rose ");
  }
}

TEST(HistoryChanges, level_begins_at_the_last_step) {
  History history = history_of(alternating(12, 1) + alternating(8, 0) + std::vector<double>{1.045});
  find_steps(history);
  ASSERT_EQ(history.series[0].steps.size(), 1u);
  EXPECT_EQ(compare_commits(history, 19, 20).changes.size(), 1u);
}

TEST(HistoryChanges, two_commits_alone_are_undecided_without_seeds) {
  History history = history_of({1, 2}, Measure::processor_seconds);
  find_steps(history);
  const reports::HistoryComparison comparison = compare_commits(history, 0, 1);
  EXPECT_EQ(comparison.undecided, 1u);
  EXPECT_EQ(reports::comparison_sentence(comparison), "Nothing can be compared yet");
  // Seeds tell the noise of errors, but not how sessions differ in time.
  for (const Measure measure : {Measure::relmse, Measure::processor_seconds}) {
    History seeded = history_of({1, 2}, measure);
    for (reports::HistoryPoint& point : seeded.series[0].points)
      point.interval = Interval{point.value * 0.95, point.value * 1.05};
    find_steps(seeded);
    EXPECT_EQ(compare_commits(seeded, 0, 1).changes.size(), measure == Measure::relmse ? 1u : 0u);
  }
}

TEST(HistoryChanges, noise_alone_rarely_changes_anything) {
  int changed = 0;
  for (int run = 0; run < 400; ++run) {
    std::vector<double> values;
    // Deterministic and uneven: fractions of multiples of the golden ratio, of an even distribution.
    for (int i = 0; i < 12; ++i) values.push_back(1 + 0.05 * std::fmod((run * 12 + i + 1) * 0.6180339887, 1.0));
    History history = history_of(values);
    find_steps(history);
    changed += static_cast<int>(compare_commits(history, 10, 11).changes.size());
  }
  EXPECT_LE(changed, 4);  // 1 % of 400
}

TEST(HistoryChanges, gates_are_listed_when_their_verdict_changes_or_is_no_pass) {
  History history = history_of({0.001, 0.001, 0.001, 0.05}, Measure::gate);
  history.series[0].key.budget = "bias";
  for (std::size_t i = 0; i < 4; ++i)
    history.series[0].points[i].verdict = i < 3 ? GateVerdict::pass : GateVerdict::fail;
  find_steps(history);
  const reports::HistoryComparison worse = compare_commits(history, 2, 3);
  ASSERT_EQ(worse.gates.size(), 1u);
  EXPECT_TRUE(reports::is_worse(worse));
  EXPECT_TRUE(reports::comparison_sentence(worse).ends_with("; 1 gate fails"));
  EXPECT_TRUE(compare_commits(history, 1, 2).gates.empty());
  history.series[0].points[2].verdict = GateVerdict::fail;
  EXPECT_EQ(compare_commits(history, 2, 3).gates.size(), 1u);
  reports::HistoryComparison gates_alone;
  gates_alone.gates = compare_commits(history, 2, 3).gates;
  EXPECT_FALSE(reports::is_worse(gates_alone));
}

TEST(HistoryChanges, repeated_value_changes_from_one_percent_on) {
  for (const auto& [value, found] : {std::pair(1.011, 1u), std::pair(1.009, 0u)}) {
    History history = history_of({1, 1, 1, value});
    find_steps(history);
    EXPECT_EQ(compare_commits(history, 2, 3).changes.size(), found) << value;
  }
}

TEST(HistoryChanges, commits_are_found_by_their_beginning) {
  History history = history_of({1, 2, 3});
  history.commits[0].name = "abcdef";
  history.commits[1].name = "abc123";
  EXPECT_EQ(find_commit(history, "--base", "abcd"), 0u);
  EXPECT_EQ(find_commit(history, "--base", "c2"), 2u);
  EXPECT_EQ(input_error_of([&] { find_commit(history, "--base", "abc"); }),
            "--base: error: 'abc' is the beginning of 2 commits");
  EXPECT_EQ(input_error_of([&] { find_commit(history, "--base", "zz"); }),
            "--base: error: the history has no commit 'zz'");
}

}  // namespace
}  // namespace photonproof::inline harness_history
