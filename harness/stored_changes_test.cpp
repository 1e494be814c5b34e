#include "harness/stored_changes.h"

#include <gtest/gtest.h>

namespace photonproof {
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

// The medians' intervals are [1, 1.05] each, so the ratio's is that of the medians * [1/1.05, 1.05], widened by 1.25:
// 3 % lie inside, a factor of 2 far outside.
TEST(StoredChanges, small_change_of_time_is_inconclusive_and_a_factor_of_two_is_not) {
  EXPECT_EQ(change_of(run(1, 0.1), run(1.03, 0.1), "seconds"), Change::inconclusive);
  EXPECT_EQ(change_of(run(1, 0.1), run(2, 0.1), "seconds"), Change::regression);
  EXPECT_EQ(change_of(run(2, 0.1), run(1, 0.1), "seconds"), Change::improvement);
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
}  // namespace photonproof
