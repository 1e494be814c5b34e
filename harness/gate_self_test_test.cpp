#include "harness/gate_self_test.h"

#include "harness/test_gates.h"

namespace photonproof {
namespace {

class GateSelfTest : public FakeGateTest {};

TEST_F(GateSelfTest, planted_faults_are_counted_as_found_and_healthy_runs_are_not) {
  put_reference();
  put("gates.toml", gates_text(gate("good", "agreement", 0.05) + gate("good", "flip", 0.9)));
  const GateSuite suite = read_gate_suite(folder_ / "gates.toml");
  SelfTestOptions options;
  options.gates.folder = folder_ / "out";
  options.runs = 20;
  options.pool = 24;
  std::filesystem::create_directories(options.gates.folder);
  const SelfTest test = run_self_test(suite, options);
  ASSERT_EQ(test.gates.size(), 2u);
  for (std::size_t v = 0; v < test.variants.size(); ++v) {
    const Variant& variant = test.variants[v];
    if (variant.draws_its_own()) {  // a shell script has no faults to plant and no instruction sets
      EXPECT_EQ(test.counts[v][0].runs, 0) << variant.name;
      continue;
    }
    EXPECT_EQ(test.counts[v][0].runs, variant.is_mutant ? 20 : 100) << variant.name;
    // 8 images of 2 % noise a value: each of the faults is many deviations off.
    EXPECT_EQ(test.counts[v][0].fail, variant.is_mutant ? 20 : 0) << variant.name;
    // flip cannot pass 0.9 here: that gate finds what is not finite, and nothing else.
    EXPECT_EQ(test.counts[v][1].fail, variant.name == "NaN" ? 20 : 0) << variant.name;
  }
  const std::string table = self_test_table(suite, test, "command");
  EXPECT_NE(table.find("| scene/good/agreement |"), std::string::npos) << table;
  EXPECT_NE(table.find("Not found in 99 of 100 runs: dropped cosine."), std::string::npos) << table;
  EXPECT_FALSE(self_test_passes(test));
}

}  // namespace
}  // namespace photonproof
