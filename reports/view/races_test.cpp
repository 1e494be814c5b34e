#include "reports/view/races.h"

#include <numeric>

#include "reports/view/console_conclusions.h"
#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_view {
namespace {

using Time = RaceRecord::Time;

RaceRecord race_of(const std::string& scene, const std::vector<Time>& times) {
  RaceRecord race;
  race.scene = scene;
  race.relmse = 0.001;
  race.times = times;
  return race;
}

Time first(const std::string& engine) { return {.engine = engine, .seconds = 1}; }
Time slower(const std::string& engine, double ratio, std::optional<Interval> interval) {
  return {.engine = engine, .seconds = ratio, .ratio = Estimate{ratio, interval}};
}

TEST(Races, say_how_many_times_sooner_with_the_interval) {
  const RaceRecord race = sample_races().front();
  EXPECT_EQ(race_text(race),
            "photon reaches relMSE 0.050 on box 9.0 to 11 times sooner than path; povray needs ≤ 2.5 s, which leaves "
            "the order open");
  EXPECT_TRUE(has_winner(race));
}

TEST(Races, call_a_difference_within_noise_a_tie) {
  const RaceRecord tie = race_of("lens", {first("path"), slower("bdpt", 1.1, Interval{0.9, 1.3})});
  EXPECT_EQ(race_text(tie),
            "path reaches relMSE 0.0010 on lens as soon as bdpt within noise (0.90 to 1.3 times its time)");
  EXPECT_FALSE(has_winner(tie));
}

TEST(Races, have_no_winner_without_an_interval) {
  const RaceRecord one_seed = race_of("lens", {first("path"), slower("bdpt", 3, {})});
  EXPECT_EQ(race_text(one_seed), "path reaches relMSE 0.0010 on lens about 3.0 times sooner than bdpt");
  EXPECT_FALSE(has_winner(one_seed));
}

TEST(Races, give_a_bound_as_a_bound) {
  Time bound{.engine = "path", .seconds = 9, .more_than = true, .ratio = Estimate{7, {}}, .at_least = true};
  const RaceRecord race = race_of("lens", {first("photonmapper"), bound});
  EXPECT_EQ(race_text(race), "photonmapper reaches relMSE 0.0010 on lens at least 7.0 times sooner than path");
  EXPECT_TRUE(has_winner(race));
}

TEST(Races, of_older_records_have_times_without_ratios) {
  const RaceRecord older = race_of("lens", {first("path"), {.engine = "bdpt", .seconds = 3}});
  EXPECT_EQ(race_text(older), "path reaches relMSE 0.0010 on lens; bdpt needs 3.0 s");
  EXPECT_FALSE(has_winner(older));
}

// Leads of 2 to 3 and of 9 to 11 times, a tie, and a win of the other engine.
TEST(Races, are_summed_up_in_one_sentence) {
  Results results;
  results.races = {race_of("a", {first("pm"), slower("path", 2.5, Interval{2, 3})}),
                   race_of("b", {first("pm"), slower("path", 10, Interval{9, 11})}),
                   race_of("c", {first("path"), slower("pm", 1.1, Interval{0.9, 1.3})}),
                   race_of("d", {first("path"), slower("pm", 4, Interval{4, 4})})};
  EXPECT_EQ(races_sentence(arrange(results)),
            "pm is fastest to the same error on 2 of 4 scenes, 2.0 to 11 times sooner than the next; path on 1, 4.0 "
            "times; 1 without a winner");
  results.races[1].times[1] = {
      .engine = "path", .seconds = 7, .more_than = true, .ratio = Estimate{7, {}}, .at_least = true};
  results.races.push_back(sample_races().back());
  EXPECT_EQ(
      races_sentence(arrange(results)),
      "pm is fastest to the same error on 2 of 5 scenes, 2.0 to more than 7.0 times sooner than the next; path on 1, "
      "4.0 times; 1 without a winner; 1 not judged");
  results.races.erase(results.races.begin());
  EXPECT_EQ(races_sentence(arrange(results)).substr(0, 75),
            "pm is fastest to the same error on 1 of 4 scenes, at least 7.0 times sooner");
  results.races.erase(results.races.begin());
  results.races.resize(1);
  EXPECT_EQ(races_sentence(arrange(results)), "No engine is known to be faster on the one scene");
  results.races.clear();
  EXPECT_EQ(races_sentence(arrange(results)), "");
}

// The photon mapper's images of the largest budget are off in the box; the other scene has no verdict.
TEST(Races, of_a_winner_that_is_not_right_say_so_in_the_sentence) {
  Results results = sample_conclusions();
  results.races.pop_back();
  EXPECT_EQ(races_sentence(arrange(results)),
            "photon is fastest to the same error on 1 of 1 scene, 9.0 to 11 times sooner than the next. Where photon "
            "wins, it "
            "is biased on 1 by 1.2 %");
  results.races.push_back(results.races.front());
  results.races.back().scene = "hole";
  const std::string two = "photon is fastest to the same error on 2 of 2 scenes, 9.0 to 11 times sooner than the next";
  EXPECT_EQ(races_sentence(arrange(results)), two + ". Where photon wins, it is biased on 1 by 1.2 %");
  // The hole has images of its own, whose verdict stands in a copy of the box's curve.
  Convergence curve = results.convergence.front();
  curve.scene = "hole";
  const auto with = [&](Correctness verdict) {
    curve.points.back().correctness->verdict = verdict;
    Results more = results;
    more.convergence.push_back(curve);
    for (std::size_t i = 0, count = more.results.size(); i < count; ++i)
      if (more.results[i].cell.scene == "box" && more.results[i].cell.engine == "photon") {
        more.results.push_back(more.results[i]);
        more.results.back().cell.scene = "hole";
      }
    return races_sentence(arrange(more));
  };
  EXPECT_EQ(with(Correctness::right), two + ". Where photon wins, it is right on 1, biased on 1 by 1.2 %");
  EXPECT_EQ(with(Correctness::noisy), two + ". Where photon wins, it is biased on 1 by 1.2 %, too noisy to judge on 1");
  EXPECT_EQ(with(Correctness::biased), two + ". Where photon wins, it is biased on 2 by up to 1.2 %");
}

TEST(Races, name_who_has_less_error_in_the_same_time_beyond_noise) {
  RaceRecord race = sample_races().front();
  EXPECT_EQ(error_lead_text(race), "photon: 7.0 to 9.0 times less");
  race.errors[1].ratio->interval = Interval{0.9, 9};
  EXPECT_EQ(error_lead_text(race), "");
  race.errors.pop_back();
  EXPECT_EQ(error_lead_text(race), "");
}

// A scene with two targets has two races with the same errors. The winner's lead is beyond noise.
TEST(Races, have_errors_in_the_same_time_once_a_scene) {
  Results results = sample_conclusions();
  results.engines.push_back({"path", "path tracer", "0.1.0"});
  results.races.push_back(results.races.front());
  View view = arrange(results);
  view.compared.resize(results.engines.size());
  std::iota(view.compared.begin(), view.compared.end(), 0u);
  const auto row_of = [&](const RaceTable& table) {
    std::string text;
    for (const RaceTable::Row& row : table.rows) {
      text += row.scene + " " + row.at + ":";
      for (std::size_t i = 0; i < row.cells.size(); ++i)
        text += " " + table.engines[i] + " " + row.cells[i].value + (row.cells[i].best ? "!" : "") + " " +
                row.cells[i].ratio + ",";
    }
    return text;
  };
  EXPECT_EQ(row_of(error_table(view)), "box 2.0 s: photon 0.030! , povray – , path 0.24 7.0 to 9.0 times,");
  results.races.pop_back();
  results.races.front().errors[1].ratio->interval = Interval{0.9, 9};
  view.races = arrange(results).races;
  EXPECT_EQ(row_of(error_table(view)), "box 2.0 s: photon 0.030 , povray – , path 0.24 0.90 to 9.0 times,");
}

TEST(Races, are_a_table_of_scenes_and_engines_on_the_console) {
  const Results results = sample_conclusions();
  const std::string text = console_conclusions(arrange(results), true);
  EXPECT_NE(text.find("\033[1m1.2 s\033[0m"), std::string::npos) << "the winner in bold: " << text;
  const std::string plain = console_conclusions(arrange(results), false);
  EXPECT_EQ(plain.find('\033'), std::string::npos);
  EXPECT_NE(plain.find("time to  relMSE  photon  povray\n"
                       "box      0.050   1.2 s   ≤ 2.5 s\n"
                       "hole: not judged, the measured errors decide no order: photon 0.2, povray 0.1\n\n"
                       "relMSE in  time   photon  povray\n"
                       "box        2.0 s  0.030   –\n"),
            std::string::npos)
      << plain;
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
