#include "harness/gates/gate_self_tests.h"

#include <algorithm>
#include <set>

#include "harness/gates/test_gates.h"

namespace photonproof::inline harness_gates {
namespace {

class GateSelfTest : public FakeGateTest {
 protected:
  /// Runs the self-test of gates on prepared images.
  SelfTest self_test(const std::string& gates, int seconds = 20) {
    put_reference();
    put("gates.toml", gates_text(gates, seconds));
    suite_ = read_gate_suite(folder_ / "gates.toml");
    SelfTestOptions options;
    options.gates.folder = folder_ / "out";
    options.runs = 20;
    options.pool = {24};
    std::filesystem::create_directories(options.gates.folder);
    return run_self_test(suite_, options);
  }
  static std::size_t number_of(const SelfTest& test, const std::string& name) {
    for (std::size_t v = 0; v < test.variants.size(); ++v)
      if (test.variants[v].name == name) return v;
    ADD_FAILURE() << name;
    return 0;
  }
  long images_drawn() const {
    const std::string log = get("log");
    return std::count(log.begin(), log.end(), '\n');
  }

  GateSuite suite_;
};

TEST_F(GateSelfTest, planted_faults_are_counted_as_found_and_healthy_runs_are_not) {
  const SelfTest test = self_test(gate("good", "agreement", 0.05) + gate("good", "flip", 0.9));
  ASSERT_EQ(test.gates.size(), 2u);
  // A shell script has no renderer's faults and no instruction sets, and does not use its budget.
  const std::set<std::string> not_here{"3 threads", "scalar kernels", "quarter-budget"};
  for (std::size_t v = 0; v < test.variants.size(); ++v) {
    const GateVariant& variant = test.variants[v];
    if (variant.planted == PlantedIn::renderer || not_here.count(variant.name) > 0) {
      EXPECT_EQ(test.counts[v][0].runs, 0) << variant.name;
      EXPECT_EQ(test.any[v].runs, 0) << variant.name;
      continue;
    }
    EXPECT_EQ(test.counts[v][0].runs, variant.is_mutant() ? 20 : 100) << variant.name;
    // Eight images of 2 % noise a value, in twelve blocks a channel: each fault is many deviations off.
    EXPECT_EQ(test.counts[v][0].fail, variant.is_mutant() ? 20 : 0) << variant.name;
    // flip cannot exceed 0.9 here: that gate finds only values that are not finite.
    EXPECT_EQ(test.counts[v][1].fail, variant.name == "NaN" ? 20 : 0) << variant.name;
    EXPECT_EQ(test.any[v].fail, test.counts[v][0].fail) << variant.name;
  }
}

TEST_F(GateSelfTest, table_has_a_row_a_mutant_with_its_finders_and_a_row_a_gate_with_its_false_alarms) {
  SelfTest test = self_test(gate("good", "agreement", 0.05) + gate("good", "flip", 0.9));
  const std::size_t hole = number_of(test, "hole");
  test.counts[hole][1].fail = 7;  // of 20
  const std::string table = self_test_table(suite_, test, "the command");
  for (const char* part :
       {"# What the gates of `fake` find\n\n```sh\nthe command\n```\n",
        "## In the harness\n\n| planted | at least one gate | found by (in % of runs where not always) |\n",
        "| **upside-down**: engines' images are read upside down | 100 | good/agreement: scene |\n",
        "| **hole**: a square of a twelfth of the sides is black | 100 | good/agreement: scene; good/flip: scene 35 "
        "|\n",
        "| gate | images | other seeds | inconclusive | alarms of disjoint runs | most that alpha explains |\n",
        "| scene/good/agreement | 24 | 0 | 0 | 0 of 3 | 0 |\n", "| **at least one gate** | | **0** | | | |\n",
        "These faults change no image of this suite: dropped-cosine, "})
    EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
  EXPECT_EQ(table.find("## In the renderer"), std::string::npos) << table;
}

TEST_F(GateSelfTest, passes_when_all_that_changes_an_image_is_found) {
  SelfTest test = self_test(gate("good", "agreement", 0.05));
  const std::size_t noise = number_of(test, "certain-noise"), hole = number_of(test, "hole");
  test.any[noise].fail = test.any[noise].runs;
  EXPECT_TRUE(self_test_passes(test));
  EXPECT_NE(self_test_table(suite_, test, "").find("Every other fault that changes an image of this suite is found"),
            std::string::npos);
  test.any[hole].fail = 19;  // of 20
  EXPECT_FALSE(self_test_passes(test));
  EXPECT_NE(self_test_table(suite_, test, "").find("Not found in 99 of 100 runs: hole.\n"), std::string::npos);
  test.any[hole] = {};
  EXPECT_TRUE(self_test_passes(test));
  const std::size_t photons = number_of(test, "same-photons");
  test.any[photons] = {.runs = 20, .fail = 1};
  EXPECT_FALSE(self_test_passes(test));
  test.unpromised = {{"same-photons", "they are few"}};
  EXPECT_TRUE(self_test_passes(test));
  EXPECT_NE(self_test_table(suite_, test, "")
                .find("The suite does not promise to find same-photons, found in 5 % of the runs: they are few.\n"),
            std::string::npos);
  test.counts[number_of(test, "other seeds")][0].fail = 100;
  EXPECT_FALSE(self_test_passes(test));
}

TEST_F(GateSelfTest, a_limit_of_wall_time_finds_nothing) {
  // This engine sleeps when every image has seed 1.
  SelfTest test = self_test(gate("slow-at-one", "agreement", 0.05), 4);
  const std::size_t slow = number_of(test, "repeated-seed"), noise = number_of(test, "certain-noise");
  EXPECT_TRUE(test.counts[slow][0].out_of_time);
  EXPECT_EQ(test.counts[slow][0].fail, 0);
  EXPECT_EQ(test.any[slow].runs, 0);
  test.any[noise].fail = test.any[noise].runs;
  const std::string table = self_test_table(suite_, test, "");
  EXPECT_FALSE(self_test_passes(test));
  for (const char* part :
       {"repeated-seed ran into a limit of wall time and was not judged by: scene/slow-at-one/agreement.\n",
        "Not found in 99 of 100 runs: repeated-seed.\n"})
    EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
  EXPECT_EQ(table.find("repeated-seed, "), std::string::npos) << table;  // the table does not claim that it changes
                                                                         // nothing
}

TEST_F(GateSelfTest, what_a_suite_does_not_promise_is_one_of_what_is_planted) {
  put("gates.toml", gates_text("[[unpromised]]\nplanted = 'hole'\nwhy = 'it is small'\n" + gate("good", "flip", 0.9)));
  const GateSuite suite = read_gate_suite(folder_ / "gates.toml");
  ASSERT_EQ(suite.unpromised.size(), 1u);
  EXPECT_EQ(suite.unpromised[0].planted, "hole");
  EXPECT_EQ(suite.unpromised[0].why, "it is small");
  put("gates.toml", gates_text("[[unpromised]]\nplanted = 'holes'\nwhy = 'x'\n" + gate("good", "flip", 0.9)));
  EXPECT_NE(input_error_of([&] { read_gate_suite(folder_ / "gates.toml"); }).find("unknown planted fault 'holes'"),
            std::string::npos);
}

TEST_F(GateSelfTest, where_a_first_look_is_unchanged_no_more_is_drawn) {
  const SelfTest test = self_test(gate("good", "agreement", 0.05));
  // 24 healthy images, and 16 of each fault here; 8 of a quarter of the budget show that the engine ignores it.
  EXPECT_EQ(images_drawn(), 24 + 16 + 16 + 8);
}

}  // namespace
}  // namespace photonproof::inline harness_gates
