// The program with scenes that only an engine reads, as the maintainer of another renderer uses it.
#include "harness/gates/test_gates.h"
#include "reports/record/results.h"
#include "scenes/base/process.h"

namespace photonproof::inline harness_gates {
namespace {

class OpaqueScene : public FakeGateTest {
 protected:
  void SetUp() override {
    FakeGateTest::SetUp();
    std::filesystem::create_directories(folder_ / "room");
    put("room/room.usd", "what only the engine reads");
    put("room/textures.txt", "beside it");
  }

  /// A suite whose scene is `path`, with these gates.
  void put_suite(const std::string& gates, const std::string& path = "'room'") const {
    std::string text = gates_text(gates);
    const std::string own = "path = 'scene.xml'";
    put("gates.toml", text.replace(text.find(own), own.size(), "path = " + path));
  }
  ProcessOutcome run(const std::vector<std::string>& words) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY};
    argv.insert(argv.end(), words.begin(), words.end());
    return run_process(argv, {.wall_limit_seconds = 60});
  }
  ProcessOutcome run_gates(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"gate", folder_ / "gates.toml", "-o", folder_ / "out"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  ProcessOutcome reference(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"reference", folder_ / "gates.toml", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  Results results() const { return read_results((folder_ / "out" / "results.json").string()); }

  /// The expectation without noise.
  void put_golden() const {
    Image golden(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) golden.pixel(x, y)[c] = static_cast<float>(expected(x, y, c));
    write_image("golden.exr", golden);
  }
};

TEST_F(OpaqueScene, a_golden_image_serves_every_kind_of_gate) {
  put_golden();
  put_suite(gate("good", "agreement", 0.05) + gate("good", "bias", 0.05) + gate("good", "block_bias", 0.1) +
            gate("good", "relmse", 0.01) + gate("dim", "agreement", 0.05));
  EXPECT_NE(run_gates().standard_error.find("has no reference"), std::string::npos);
  ASSERT_EQ(reference({"--from", folder_ / "golden.exr"}).exit_code, 0);
  const ProcessOutcome outcome = run_gates();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.standard_error;
  EXPECT_EQ(outcome.standard_output.rfind("fake: 4 pass, 1 fail, 0 inconclusive\n", 0), 0u)
      << outcome.standard_output << outcome.standard_error;
  EXPECT_NE(
      outcome.standard_output.find("note: only the engine reads scene: our own integrators, verify and the diagnosis "
                                   "by parts of light do not apply\n"),
      std::string::npos)
      << outcome.standard_output;
  EXPECT_NE(results().gates.at(0).sentence.find("the reference states no noise"), std::string::npos);
  EXPECT_TRUE(has("out/report.html"));
  EXPECT_TRUE(has("out/junit.xml"));
}

// The engine's script logs the path of {scene} that it is given.
TEST_F(OpaqueScene, the_engine_gets_a_copy_of_the_folder_and_words_as_they_are) {
  put_golden();
  put("gate.sh",
      "echo \"$5\" >\"$2/scene.txt\"; ls \"$5\" >>\"$2/scene.txt\" 2>/dev/null; cp \"$2/good-$(($4 % 64)).exr\" "
      "\"$3\"\n");
  put_suite(gate("good", "bias", 0.05));
  ASSERT_EQ(reference({"--from", folder_ / "golden.exr"}).exit_code, 0);
  EXPECT_EQ(run_gates().exit_code, 0);
  EXPECT_NE(get("scene.txt").find(".photonproof-scenes"), std::string::npos) << get("scene.txt");
  EXPECT_NE(get("scene.txt").find("\nroom.usd\ntextures.txt\n"), std::string::npos) << get("scene.txt");
  put_suite(gate("good", "bias", 0.05), "42");
  // The reference is of other content now, so that its replacement needs no reason.
  EXPECT_NE(run_gates().standard_error.find("is out of date"), std::string::npos);
  ASSERT_EQ(reference({"--from", folder_ / "golden.exr"}).exit_code, 0);
  EXPECT_EQ(run_gates().exit_code, 0);
  EXPECT_EQ(get("scene.txt"), "42\n");
}

TEST_F(OpaqueScene, an_engine_makes_the_reference_and_a_good_one_is_not_replaced_without_a_reason) {
  put_suite(gate("good", "agreement", 0.05));
  const ProcessOutcome made = reference({"--engine", "good"});
  ASSERT_EQ(made.exit_code, 0) << made.standard_error;
  EXPECT_EQ(made.standard_output.rfind("scene: good, 32x24, 32 images, standard error ", 0), 0u)
      << made.standard_output;
  EXPECT_EQ(run_gates().exit_code, 0);
  EXPECT_NE(results().gates.at(0).regression_only.find("the reference is by good itself"), std::string::npos);
  const ProcessOutcome again = reference({"--engine", "good"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.standard_error.find("say why it is replaced with --reason TEXT"), std::string::npos);
  const ProcessOutcome accepted = run_gates({"--accept", "scene/good/agreement", "--reason", "new light"});
  EXPECT_EQ(accepted.exit_code, 0) << accepted.standard_error;
  EXPECT_NE(get("references/scene/reference-32x24.json").find("new light"), std::string::npos)
      << accepted.standard_output << accepted.standard_error;
  EXPECT_EQ(run_gates().exit_code, 0);
}

TEST_F(OpaqueScene, a_bench_takes_the_same_reference) {
  put_golden();
  put_suite(gate("good", "bias", 0.05));
  ASSERT_EQ(reference({"--from", folder_ / "golden.exr"}).exit_code, 0);
  std::string text = get("gates.toml");
  text.resize(text.find("[[gate]]"));
  put("bench.toml", text + "[[run]]\nengine = 'good'\nbudgets = ['spp=64']\nseeds = [1, 2, 3]\n");
  const ProcessOutcome outcome = run({"bench", folder_ / "bench.toml", "-o", folder_ / "bench"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_NE(outcome.standard_output.find("scene  good    64 spp  right within"), std::string::npos)
      << outcome.standard_output;
}

TEST_F(OpaqueScene, at_most_so_many_pixels_may_be_off) {
  put_golden();
  const std::string some = gate("dim", "differing_pixels", 48) + "more_than = 0.1\nname = 'all'\n",
                    fewer = gate("dim", "differing_pixels", 47) + "more_than = 0.1\nname = 'fewer'\n";
  std::string share = gate("dim", "differing", 0) + "more_than = 0.1\nname = 'share'\n";
  share.replace(share.find("bound = 0.000000"), 16, "bound = '6.26 %'");
  put_suite(some + fewer + share);
  ASSERT_EQ(reference({"--from", folder_ / "golden.exr"}).exit_code, 0);
  run_gates();
  const Results judged = results();  // "dim" halves 6 x 8 pixels of 32 x 24, 6.25 %
  EXPECT_EQ(judged.gates.at(0).verdict, GateVerdict::pass) << judged.gates.at(0).sentence;
  EXPECT_EQ(judged.gates.at(1).verdict, GateVerdict::fail) << judged.gates.at(1).sentence;
  EXPECT_EQ(judged.gates.at(2).verdict, GateVerdict::pass) << judged.gates.at(2).sentence;
}

}  // namespace
}  // namespace photonproof::inline harness_gates
