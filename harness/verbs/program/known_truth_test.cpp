// A record of known truth: one engine is exactly ten times as fast as another at equal error. Every format that tells
// of races has to state this factor within its interval.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <regex>

#include "harness/conclusions/race.h"
#include "harness/statistics/statistics.h"
#include "reports/formats/formats.h"
#include "reports/view/console_conclusions.h"
#include "reports/view/races.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs_program {
namespace {

constexpr double truth = 10;

using KnownTruth = FolderTest;

/// Five seeds a budget: errors of relmse_at_one_second / t vary by 5 %, and one seed in twenty has a firefly that
/// doubles its error. Times vary by 3 %.
Convergence measured(const std::string& engine, double relmse_at_one_second, const std::vector<double>& times,
                     std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Convergence curve;
  curve.scene = "box";
  curve.engine = engine;
  for (const double time : times) {
    std::vector<double> errors, seconds;
    for (int seed = 0; seed < 5; ++seed) {
      const double firefly = uniform(random) < 0.05 ? 1 : 0;
      errors.push_back(relmse_at_one_second / time * (std::exp(0.05 * normal(random)) + firefly));
      seconds.push_back(time * std::exp(0.03 * normal(random)));
    }
    ConvergencePoint& point = curve.points.emplace_back();
    point.budget = {"spp", 16 * time};
    point.seeds = 5;
    point.seconds = estimated_time(seconds);
    point.relmse = estimated_mean(errors);
  }
  return curve;
}

/// The record, with a bound on each side: "early" has less error than asked for at its first budget, and "late" more at
/// its last.
Results known_record() {
  std::mt19937_64 random(7);
  Results results;
  results.suite = "truth";
  results.created = "2026-02-03T04:05:06Z";
  results.host = {"Some CPU", "Debian 12", "Linux 6.1", 2, std::uint64_t{8} << 30};
  results.scenes.push_back({"box", "box.xml", "", 8, 8, 0, ""});
  for (const char* name : {"fast", "slow", "early", "late"}) {
    results.engines.push_back({name, "", "1"});
    Result result;
    result.cell = {"box", name, {"spp", 16}, 1};
    result.key = "key";
    result.wall_seconds = 1;
    results.results.push_back(result);
  }
  results.convergence = {measured("fast", 0.01, {1, 4, 16, 64}, random), measured("slow", 0.1, {1, 4, 16, 64}, random),
                         measured("early", 0.0005, {4.5}, random), measured("late", 300, {10, 1000}, random)};
  for (Convergence& curve : results.convergence) curve.targets = {{0.002}};
  results.races = races_of(results.convergence);
  return results;
}

/// The numbers of "9.1 to 11 times" that follows `before`.
Interval stated(const std::string& text, const std::string& before) {
  std::smatch match;
  const std::regex words(before + "[^0-9]*([0-9.]+) to ([0-9.]+) times");
  if (!std::regex_search(text, match, words)) {
    ADD_FAILURE() << "no factor after " << before << " in\n" << text.substr(0, 3000);
    return {};
  }
  return {std::stod(match[1]), std::stod(match[2])};
}

TEST_F(KnownTruth, every_format_states_the_factor_within_its_interval) {
  const Results results = known_record();
  ASSERT_EQ(results.races.size(), 1u);
  const RaceRecord& race = results.races[0];
  ASSERT_EQ(race.times.size(), 4u) << race.undecided;
  EXPECT_EQ(race.times[0].engine, "fast");
  EXPECT_EQ(race.times[1].engine, "slow");
  const Interval known = *race.times[1].ratio->interval;
  EXPECT_LE(known.low, truth);
  EXPECT_GE(known.high, truth);
  EXPECT_LT(known.high / known.low, 4) << "an interval that says something";
  EXPECT_TRUE(race.times[2].engine == "late" && race.times[2].more_than && race.times[2].at_least);
  EXPECT_TRUE(race.times[3].engine == "early" && race.times[3].at_most && race.times[3].unranked);

  const std::string words = reports::times_text(*race.times[1].ratio);
  const auto holds_truth = [&](const std::string& format, const std::string& text) {
    EXPECT_NE(text.find(words), std::string::npos) << format << " does not say " << words;
    EXPECT_NE(text.find(reports::times_text(*race.times[2].ratio, true)), std::string::npos) << format;
    const Interval interval = stated(text, "");
    EXPECT_LE(interval.low, truth) << format;
    EXPECT_GE(interval.high, truth) << format;
  };
  holds_truth("console", reports::console_conclusions(reports::arrange(results), false));
  for (const char* format : {"html", "markdown", "latex"}) {
    report_format(format).write(results, folder_, folder_ / "out");
    const std::string text = read_file(folder_ / "out");
    holds_truth(format, text.substr(text.find("Time to") != std::string::npos ? text.find("Time to") : 0));
  }
  report_format("csv").write(results, folder_, folder_ / "out");
  std::smatch match;
  const std::string csv = read_file(folder_ / "out");
  ASSERT_TRUE(std::regex_search(csv, match, std::regex("slow,,,,ratio_of_seconds,([^,]*),([^,]*),([^,]*),")));
  EXPECT_EQ(std::stod(match[2]), known.low);
  EXPECT_EQ(std::stod(match[3]), known.high);
  write_results((folder_ / "results.json").string(), results);
  EXPECT_EQ(read_results((folder_ / "results.json").string()).races, results.races);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_program
