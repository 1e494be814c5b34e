// The page and the comment of a history: untrusted names, long series, and what they say.
#include "reports/history/history_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "reports/history/history_comparison.h"
#include "reports/history/history_plot.h"
#include "reports/history/history_words.h"
#include "scenes/files/test_folder.h"

namespace photonproof::reports::inline reports_history {
namespace {

constexpr const char* hostile = "<script>alert('x')</script>|`\"&";

History long_history(std::size_t commits, std::size_t series) {
  History history;
  for (std::size_t i = 0; i < commits; ++i)
    history.commits.push_back({"commit" + std::to_string(i), static_cast<std::int64_t>(86'400 * i)});
  for (std::size_t s = 0; s < series; ++s) {
    HistorySeries made;
    made.key = {"suite", "scene" + std::to_string(s / 4), "64x64", "path", "16 spp", static_cast<Measure>(s % 4)};
    for (std::size_t i = 0; i < commits; ++i)
      made.points.push_back({i, 1 + 0.1 * std::sin(static_cast<double>(i * (s + 1))), {}, 3, {}});
    made.levels = {1};
    history.series.push_back(made);
  }
  history.records = commits;
  return history;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

class HistoryPage : public FolderTest {
 protected:
  std::string page_of(const History& history) const {
    write_history_page(history, hostile, folder_ / "page.html");
    return get("page.html");
  }
};

TEST_F(HistoryPage, names_of_others_are_text) {
  History history = long_history(3, 4);
  for (HistoryCommit& commit : history.commits) commit.name = hostile;
  for (HistorySeries& series : history.series) {
    series.key.scene = series.key.engine = series.key.suite = hostile;
    series.key.machine = hostile;
    series.steps.push_back({1, 1, 2, true, 1, Interval{0.5, 1.5}});
    series.levels = {1, 2};
  }
  const std::string page = page_of(history);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert"), std::string::npos);
  EXPECT_EQ(count_of(page, "<script>"), 1u);  // ours
}

TEST_F(HistoryPage, begins_with_the_last_step_and_marks_it) {
  History history = long_history(20, 1);
  history.series[0].key.measure = Measure::relmse;
  history.series[0].steps.push_back({12, 1, 0.88, true, -0.12, Interval{-0.15, -0.09}});
  history.series[0].levels = {1, 0.88};
  const std::string page = page_of(history);
  EXPECT_NE(page.find("<h1>relMSE of path on scene0 fell 12 % [9.0, 15] at commit12</h1>"), std::string::npos);
  EXPECT_NE(page.find("class=\"step better\""), std::string::npos);
  EXPECT_NE(page.find(">commit12 −12 %</text>"), std::string::npos);
}

TEST_F(HistoryPage, ten_thousand_commits_of_sixty_series_stay_below_3_megabytes) {
  const std::string page = page_of(long_history(10'000, 60));
  EXPECT_LT(page.size(), 3'000'000u);
  EXPECT_LE(count_of(page, "<g class=\"point"), 12'000u);
  EXPECT_NE(page.find("commit0 to commit"), std::string::npos);
}

TEST_F(HistoryPage, numbers_of_any_size_are_drawn_inside_the_frame) {
  for (const auto& [low, high] : {std::pair(1e-308, 1e308), std::pair(-1e308, 1e308), std::pair(0.0, 0.0),
                                  std::pair(5e-324, 5e-324), std::pair(-3.0, 2.0), std::pair(1e308, 1.7e308)}) {
    History history = long_history(2, 1);
    history.series[0].points[0].value = low;
    history.series[0].points[1].value = high;
    history.series[0].levels = {low};
    const std::string svg = history_plot_svg(history, history.series[0], most_markers);
    EXPECT_EQ(svg.find("nan"), std::string::npos) << low << " " << svg;
    EXPECT_EQ(svg.find("inf"), std::string::npos) << low << " " << svg;
    EXPECT_LT(svg.size(), 4000u) << svg;
  }
}

TEST_F(HistoryPage, absent_instruction_counts_are_told) {
  History history = long_history(3, 2);
  for (HistorySeries& series : history.series) series.key.machine = "Some CPU, 2 cores";
  EXPECT_NE(page_of(history).find("<dt>Instructions</dt><dd>none"), std::string::npos);
  history.series[1].key.measure = Measure::instructions;
  EXPECT_EQ(page_of(history).find("<dt>Instructions</dt>"), std::string::npos);
}

HistoryComparison sample_comparison() {
  HistoryComparison comparison;
  comparison.base = {"aaaaaaaaaaaaaaaa", 0};
  comparison.head = {"bbbbbbbbbbbbbbbb", 1};
  comparison.changes.push_back({{"s", "cornell", "64x64", "path", "16 spp", Measure::relmse},
                                ChangeSide::worse,
                                {0, 1, 1.12, true, 0.12, Interval{0.09, 0.15}}});
  comparison.gates.push_back(
      {{"s", "cornell", "64x64", "path", "bias", Measure::gate}, GateVerdict::pass, GateVerdict::fail});
  comparison.pictures.push_back(
      {"cornell", "path", "16 spp", "c/1-old.png", "c/1-new.png", "c/1-difference.png", 0.012, {}});
  comparison.pictures_compared = 3;
  comparison.pictures_changed = 1;
  comparison.compared = 8;
  comparison.only_head = 1;
  return comparison;
}

TEST(HistoryComment, has_sentence_table_and_pictures) {
  EXPECT_EQ(comparison_markdown(sample_comparison(), "https://example.org/pr/"),
            "### photonproof: relMSE of path on cornell rose 12 % \\[9.0, 15\\]; 1 gate fails\n\n"
            "bbbbbbbbbb compared with aaaaaaaaaa. 8 series compared, 1 new.\n\n"
            "| | quantity | scene, engine, budget | base | head | change |\n|---|---|---|--:|--:|---|\n"
            "| **worse** | relMSE | cornell 64x64, path, 16 spp | 1.00 | 1.12 | rose 12 % [9.0, 15] |\n\n"
            "| gate | scene, engine | base | head |\n|---|---|---|---|\n"
            "| bias | cornell 64x64, path | pass | fail |\n\n"
            "<details open><summary>1 of 3 pictures changed</summary>\n\n"
            "| | old | new | difference |\n|---|---|---|---|\n"
            "| cornell, path, 16 spp<br>FLIP 0.0120 "
            "| <img src=\"https://example.org/pr/c/1-old.png\" alt=\"old\" width=\"256\"> "
            "| <img src=\"https://example.org/pr/c/1-new.png\" alt=\"new\" width=\"256\"> "
            "| <img src=\"https://example.org/pr/c/1-difference.png\" alt=\"difference\" width=\"256\"> |\n\n"
            "</details>\n");
}

TEST(HistoryComment, names_of_others_are_no_markup_and_the_comment_fits) {
  HistoryComparison comparison = sample_comparison();
  comparison.changes[0].key.scene = hostile;
  comparison.changes.resize(500, comparison.changes[0]);
  comparison.gates.resize(500, comparison.gates[0]);
  comparison.pictures[0].scene = hostile;
  const std::string comment = comparison_markdown(comparison, "");
  EXPECT_EQ(comment.find("<script>"), std::string::npos);
  EXPECT_NE(comment.find("440 more are on the page"), std::string::npos);
  EXPECT_LT(comment.size(), 65'536u);
}

TEST(HistoryComment, without_a_change_says_so) {
  HistoryComparison comparison;
  comparison.compared = 12;
  EXPECT_EQ(comparison_sentence(comparison), "No change beyond noise in 12 series");
  EXPECT_FALSE(is_worse(comparison));
}

TEST(HistoryWords, values_have_units) {
  const SeriesKey key{"", "", "", "", "", Measure::instructions};
  EXPECT_EQ(value_text(key, 2.314e9), "2.31 G");
  const SeriesKey gate{"", "", "", "", "agreement", Measure::gate},
      likeness{"", "", "", "", "ssim, mine", Measure::gate};
  EXPECT_EQ(value_text(gate, 0.0004), "+0.040 %");
  EXPECT_EQ(value_text(gate, -0.031), "−3.1 %");
  EXPECT_EQ(value_text(gate, -4e-6), "0 %");
  EXPECT_EQ(value_text(likeness, 0.98), "0.980");
  EXPECT_TRUE(is_worse(gate, {0, 0.01, -0.03, false, -0.04, {}}));
  EXPECT_FALSE(is_worse(gate, {0, 0.05, -0.03, false, -0.08, {}}));
  EXPECT_TRUE(is_worse(likeness, {0, 0.9, 0.8, false, -0.1, {}}));
  EXPECT_EQ(commit_text("0123456789abcdef0123"), "0123456789");
  EXPECT_EQ(commit_text("release-candidate-1"), "release-candidate-1");
  EXPECT_EQ(date_text(1795955633), "2026-11-29 12:33 UTC");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_history
