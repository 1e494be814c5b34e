#include "harness/conclusions/stored_changes.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace photonproof::inline harness_conclusions {
namespace {

const Cell cell{"s", "path", {"spp", 16}, 1};

// Six seeds that took seconds * 1.00 ... 1.05 and have relmse * 1.00 ... 1.05.
Results run(double seconds, double relmse) {
  Results results;
  results.host.cpu = "a processor";
  results.host.cores = 2;
  results.scenes.push_back({"s", "s.xml", "", 16, 16, 0, "s/ref/spp=1000/seed=0", {}});
  Result reference;
  reference.cell = {"s", "ref", {"spp", 1000}, 0};
  reference.key = "abc";
  results.results.push_back(reference);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const double factor = 1 + 0.01 * static_cast<double>(seed - 1);
    Result result;
    result.cell = cell;
    result.cell.seed = seed;
    result.cpu_seconds = seconds * factor;
    result.metrics = {{"relmse", relmse * factor, ""}};
    results.results.push_back(result);
  }
  return results;
}

Change change_of(const Results& was, const Results& is, const std::string& quantity) {
  for (const ChangeRecord& record : stored_changes(was, is, cell, {}))
    if (record.quantity == quantity) return record.change;
  throw std::out_of_range(quantity);
}

// The medians' intervals are [1, 1.05] each. The ratio's interval is that of the medians * [1/1.05, 1.05], widened by
// 1.25: 3 % lie inside, a factor of 2 far outside.
TEST(StoredChanges, small_change_of_time_is_inconclusive_and_a_factor_of_two_is_not) {
  EXPECT_EQ(change_of(run(1, 0.1), run(1.03, 0.1), "seconds"), Change::inconclusive);
  EXPECT_EQ(change_of(run(1, 0.1), run(2, 0.1), "seconds"), Change::regression);
  EXPECT_EQ(change_of(run(2, 0.1), run(1, 0.1), "seconds"), Change::improvement);
}

// Six logarithms: the median's ends lie 0.357 = (1/2)/(1 + 4/10) of the way from the extremes to the next values
// (statistics.h). Each median lies within [1.00356, 1.04642], whose ends have the ratio 1.04272. The ratio 2 then lies
// within 2 / 1.04272 / 1.25 and 2 1.04272 1.25.
TEST(StoredChanges, interval_of_the_ratio_is_that_of_both_medians_and_of_the_session) {
  const ChangeRecord twice = stored_changes(run(1, 0.1), run(2, 0.1), cell, {}).at(0);
  EXPECT_NEAR(twice.ratio.value, 2, 1e-12);
  EXPECT_NEAR(twice.ratio.interval->low, 1.534470, 1e-6);
  EXPECT_NEAR(twice.ratio.interval->high, 2.606764, 1e-6);
}

// The same six cells with a calibration that takes `calibration` seconds.
Results calibrated_run(double seconds, double calibration) {
  Results results = run(seconds, 0.1);
  for (Result& result : results.results) result.calibration = CalibrationReading{"1 (a compiler)", 2, calibration};
  return results;
}

ChangeRecord change_of_seconds(const Results& was, const Results& is) {
  return stored_changes(was, is, cell, {}).at(0);
}

// Cells and calibration both take 1.4 times as long: the ratio is 1, where the times alone give 1.4 / 1.05 / 1.25
// > 1.015.
TEST(StoredChanges, machine_that_slowed_down_is_no_change) {
  const ChangeRecord slowed = change_of_seconds(calibrated_run(1, 0.01), calibrated_run(1.4, 0.014));
  EXPECT_NEAR(slowed.ratio.value, 1, 1e-12);
  EXPECT_EQ(slowed.change, Change::inconclusive);
  EXPECT_EQ(change_of(run(1, 0.1), run(1.4, 0.1), "seconds"), Change::regression);
}

// A factor of 1.3 is found on a machine 1.4 times as slow or as fast. In the latter case the times alone show no
// change.
TEST(StoredChanges, slow_down_is_called_on_a_machine_of_another_speed) {
  for (const double machine : {1.4, 1 / 1.4}) {
    const ChangeRecord slower =
        change_of_seconds(calibrated_run(1, 0.01), calibrated_run(1.3 * machine, 0.01 * machine));
    EXPECT_NEAR(slower.ratio.value, 1.3, 1e-12) << machine;
    EXPECT_EQ(slower.change, Change::regression) << machine;
    const ChangeRecord faster = change_of_seconds(calibrated_run(1.3, 0.01), calibrated_run(machine, 0.01 * machine));
    EXPECT_EQ(faster.change, Change::improvement) << machine;
  }
}

// Readings that differ by up to a factor of 2 give an interval too wide to find a factor of 1.3.
TEST(StoredChanges, noise_of_the_calibration_is_in_the_interval) {
  Results noisy = calibrated_run(1.3, 0.01);
  for (std::size_t i = 1; i < noisy.results.size(); i += 2) noisy.results[i].calibration->seconds = 0.02;
  const ChangeRecord quiet = change_of_seconds(calibrated_run(1, 0.01), calibrated_run(1.3, 0.01));
  const ChangeRecord unsure = change_of_seconds(calibrated_run(1, 0.01), noisy);
  EXPECT_EQ(quiet.change, Change::regression);
  EXPECT_EQ(unsure.change, Change::inconclusive);
  const auto width = [](const ChangeRecord& record) {
    return record.ratio.interval->high / record.ratio.interval->low;
  };
  EXPECT_GT(width(unsure), 1.9 * width(quiet));
}

// Without the calibration 1.3 is within 1.25 and the noise, and the record gives the reason.
TEST(StoredChanges, record_without_the_same_calibration_is_judged_by_its_times_and_says_so) {
  const auto ending = [](const ChangeRecord& record) {
    const std::size_t at = record.sentence.find("widened");
    return record.sentence.substr(at, record.sentence.find(';') - at);
  };
  Results one_missing = calibrated_run(1, 0.01), other_workload = calibrated_run(1, 0.01);
  one_missing.results.back().calibration.reset();
  for (Result& result : other_workload.results) result.calibration->workload = "1 (another compiler)";
  const Results now = calibrated_run(1.3, 0.02);
  EXPECT_EQ(change_of_seconds(run(1, 0.1), now).change, Change::inconclusive);
  EXPECT_NEAR(change_of_seconds(run(1, 0.1), now).ratio.value, 1.3, 1e-12);
  EXPECT_EQ(ending(change_of_seconds(run(1, 0.1), now)),
            "widened by 25 % for the change of session, as the old run has no calibration");
  EXPECT_EQ(ending(change_of_seconds(one_missing, now)),
            "widened by 25 % for the change of session, as the old run has no calibration");
  EXPECT_EQ(ending(change_of_seconds(now, run(1, 0.1))),
            "widened by 25 % for the change of session, as this run has no calibration");
  EXPECT_EQ(ending(change_of_seconds(other_workload, now)),
            "widened by 25 % for the change of session, as the old run's calibration was another (1 (another "
            "compiler), threads 2)");
}

TEST(StoredChanges, times_of_another_machine_decide_nothing) {
  Results old_run = run(1, 0.1);
  old_run.host.cpu = "another processor";
  const std::vector<ChangeRecord> records = stored_changes(old_run, run(2, 0.1), cell, {});
  EXPECT_EQ(records[0].change, Change::inconclusive);
  EXPECT_EQ(records[0].sentence,
            "cannot tell whether it is slower: the old run was made on another machine (another processor); "
            "--old-program PATH would decide it");
}

TEST(StoredChanges, few_seeds_give_times_without_an_interval) {
  Results old_run = run(1, 0.1);
  old_run.results.resize(4);
  EXPECT_EQ(change_of(old_run, run(2, 0.1), "seconds"), Change::inconclusive);
}

// Paired by seed, the ratio is the same for all six, so its interval has no width.
TEST(StoredChanges, errors_are_paired_by_seed) {
  EXPECT_EQ(change_of(run(1, 0.1), run(1, 0.1), "relmse"), Change::unchanged);
  EXPECT_EQ(change_of(run(1, 0.1), run(1, 0.12), "relmse"), Change::regression);
  EXPECT_EQ(change_of(run(1, 0.1), run(1, 0.08), "relmse"), Change::improvement);
}

TEST(StoredChanges, errors_against_another_reference_are_not_compared) {
  Results now = run(1, 0.1);
  now.results[0].key = "def";
  EXPECT_EQ(stored_changes(run(1, 0.1), now, cell, {}).size(), 1u);
}

TEST(StoredChanges, budget_of_seconds_has_no_change_of_time) {
  Results was = run(1, 0.1), is = run(2, 0.1);
  Cell timed = cell;
  timed.budget = {"seconds", 1};
  for (Results* results : {&was, &is})
    for (std::size_t i = 1; i < results->results.size(); ++i) results->results[i].cell.budget = timed.budget;
  const std::vector<ChangeRecord> records = stored_changes(was, is, timed, {});
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].quantity, "relmse");
}

}  // namespace
}  // namespace photonproof::inline harness_conclusions
