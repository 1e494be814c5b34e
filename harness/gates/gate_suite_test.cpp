#include "harness/gates/gate_suite.h"

#include <algorithm>

#include "harness/gates/gate_look.h"
#include "harness/references/suite_scene.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr const char* head = "name = 'tiny'\ntitle = 'Tiny'\n";
constexpr const char* scene_table = "[[scene]]\nname = 'a'\npath = 'a.xml'\nwidth = 8\nheight = 16\n";

class GateSuiteFile : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    put("a.xml", "");
  }
  GateSuite read(const std::string& text) const {
    put("g.toml", text);
    return read_gate_suite(folder_ / "g.toml");
  }
  /// The first line of the error, without the folder.
  std::string error(const std::string& text) const {
    std::string message = input_error_of([&] { read(text); });
    message.resize(std::min(message.size(), message.find('\n')));
    const std::string prefix = folder_.string() + "/";
    return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
  }
};

std::string gate(const std::string& rows) { return "[[gate]]\nscene = 'a'\n" + rows; }

TEST_F(GateSuiteFile, a_gate_takes_what_it_does_not_say_from_the_suite) {
  const GateSuite suite =
      read(std::string(head) + "alpha = 0.01\nseeds = 4\nlooks = 3\n" + scene_table +
           gate("engine = 'path'\nbudget = 'spp=16'\nmetric = 'agreement'\nbound = 0.02\n") +
           gate("engine = 'photonmapper'\nbudget = 'spp=4'\nmetric = 'flip'\nbound = 0.1\nname = 'own'\nalpha = 0.1\n"
                "seeds = 6\nlooks = 1\n"));
  ASSERT_EQ(suite.gates.size(), 2u);
  const Gate& first = suite.gates[0];
  EXPECT_EQ(first.name, "a/path/agreement");
  EXPECT_EQ(first.alpha, 0.01);
  EXPECT_EQ(first.seeds, 4);
  EXPECT_EQ(first.looks, 3);
  EXPECT_EQ(first.bound, 0.02);
  EXPECT_EQ(first.block_bound, 0.1);  // five times bound
  const Gate& second = suite.gates[1];
  EXPECT_EQ(second.name, "own");
  EXPECT_EQ(second.alpha, 0.1);
  EXPECT_EQ(second.seeds, 6);
  EXPECT_EQ(second.looks, 1);
  EXPECT_EQ(suite.limits.threads, 1);
}

TEST_F(GateSuiteFile, a_row_with_several_scenes_and_engines_is_a_gate_for_each_pair) {
  put("b.xml", "");
  const std::string both =
      std::string(head) + scene_table + "[[scene]]\nname = 'b'\npath = 'b.xml'\nwidth = 8\nheight = 8\n";
  const std::string rest = "budget = 'spp=1'\nmetric = 'bias'\nbound = 0.1\n";
  const auto names = [&](const std::string& row) {
    std::vector<std::string> all;
    for (const Gate& gate : read(both + "[[gate]]\n" + row + rest).gates) all.push_back(gate.name);
    return all;
  };
  const std::vector<std::string> four{"a/path/bias", "a/bdpt/bias", "b/path/bias", "b/bdpt/bias"};
  EXPECT_EQ(names("scene = ['a', 'b']\nengine = ['path', 'bdpt']\n"), four);
  EXPECT_EQ(names("scenes = ['a', 'b']\nengines = ['path', 'bdpt']\n"), four);
  EXPECT_EQ(names("name = 'n'\nscene = ['a', 'b']\nengine = 'path'\n"),
            (std::vector<std::string>{"n/a/path", "n/b/path"}));
  const auto problem = [&](const std::string& row) { return error(both + "[[gate]]\n" + row + rest); };
  EXPECT_EQ(problem("scene = ['a', 'a']\nengine = 'path'\n"), "g.toml:14:15: error: 'a' is named twice");
  EXPECT_EQ(problem("scene = []\nengine = 'path'\n"), "g.toml:14:9: error: 'scene' must not be empty");
  EXPECT_EQ(problem("scene = 'a'\nscenes = ['b']\nengine = 'path'\n"),
            "g.toml:15:10: error: 'scenes' beside 'scene': give one of them");
}

TEST_F(GateSuiteFile, only_an_engine_whose_command_has_a_seed_is_asked_for_independent_images) {
  const auto takes_seed = [&](const std::string& command) {
    return read(std::string(head) + scene_table + "[[engine]]\nname = 'mine'\ntitle = 'm'\nbudgets = ['spp']\n" +
                "trust = 'unbiased'\ncommand = " + command + "\n" +
                gate("engine = 'mine'\nbudget = 'spp=1'\nmetric = 'relmse'\nbound = 0.1\n"))
        .gates.at(0)
        .takes_seed;
  };
  EXPECT_TRUE(takes_seed("['x', '{scene}', '{output}', '-s{seed}']"));
  EXPECT_FALSE(takes_seed("['x', '{scene}', '{output}']"));
}

TEST_F(GateSuiteFile, an_engine_that_denoises_has_gates_of_one_image_alone) {
  const auto text = [](const std::string& metric) {
    return std::string(head) + scene_table + "[[engine]]\nname = 'smooth'\ntitle = 's'\nbudgets = ['spp']\n" +
           "command = ['{photonproof}', 'render', '{scene}', '-o', '{output}', '--seed', '{seed}']\n" +
           "trust = 'biased'\ndenoise = true\n" +
           gate("engine = 'smooth'\nbudget = 'spp=1'\nmetric = '" + metric + "'\nbound = 0.1\n");
  };
  EXPECT_EQ(read(text("relmse")).gates.at(0).metric, "relmse");
  for (const char* metric : {"agreement", "bias", "block_bias"})
    EXPECT_EQ(
        error(text(metric)),
        "g.toml:19:10: error: engine 'smooth' denoises, which makes errors that no number of images averages out; "
        "bound a metric of one image, such as relmse")
        << metric;
}

TEST_F(GateSuiteFile, mistakes_are_told_with_their_place) {
  const std::string front = std::string(head) + scene_table;
  const std::string good = "engine = 'path'\nbudget = 'spp=16'\nmetric = 'agreement'\nbound = 0.02\n";
  EXPECT_EQ(error(front), "g.toml:1:1: error: the suite has no [[gate]]");
  EXPECT_EQ(error(front + "[[gate]]\nscene = 'b'\n" + good), "g.toml:9:9: error: unknown scene 'b'; known: a");
  EXPECT_EQ(error(front + gate("engine = 'path'\nbudget = 'photons=1e5'\nmetric = 'agreement'\nbound = 0.02\n")),
            "g.toml:11:10: error: engine 'path' takes budgets of spp, seconds, target-error; not 'photons'");
  EXPECT_EQ(error(front + gate("engine = 'photonmapper'\nbudget = 'spp=1'\nmetric = 'agreement'\nbound = 0.02\n")),
            "g.toml:12:10: error: engine 'photonmapper' has a known error, which agreement would find; bound it by "
            "bias or block_bias");
  EXPECT_EQ(error(front + gate("engine = 'path'\nbudget = 'spp=1'\nmetric = 'ssim'\nbound = 0.9\n")),
            "g.toml:12:10: error: ssim needs images of at least 11 x 11 pixels");
  EXPECT_EQ(error(front + gate("engine = 'path'\nbudget = 'spp=1'\nmetric = 'bias'\nbound = 0\n")),
            "g.toml:13:9: error: 'bound' must be positive and at most 1");
  EXPECT_EQ(error(front + gate(good) + gate(good)).substr(0, 11), "g.toml:14:1");
  EXPECT_NE(error(front + gate(good) + gate(good)).find("there is a gate 'a/path/agreement' already"),
            std::string::npos);
  EXPECT_NE(error(front + gate(good) + "blok_bound = 1\n").find("'blok_bound' (did you mean 'block_bound'?)"),
            std::string::npos);
  EXPECT_NE(error(front + gate("engine = 'path'\nbudget = 'spp=1'\nmetric = 'agrement'\nbound = 1\n"))
                .find("unknown metric 'agrement' (did you mean 'agreement'?)"),
            std::string::npos);
  EXPECT_EQ(input_error_of([&] { gates_named(read(front + gate(good)), "pth"); }),
            "--only: error: no gate of the suite has 'pth' in its name (did you mean 'path'?)");
}

TEST_F(GateSuiteFile, hdr_flip_is_bounded_only_where_the_scene_pins_its_exposures) {
  const std::string text =
      std::string(head) + scene_table + gate("engine = 'path'\nbudget = 'spp=16'\nmetric = 'hdr_flip'\nbound = 0.1\n");
  const std::string expect = "purpose = 'x'\nexposure = 0\n";
  put("expect.toml", expect);
  EXPECT_EQ(error(text),
            "g.toml:12:10: error: hdr_flip needs the scene to pin its exposures: 'hdr_flip_exposures' in " +
                (folder_ / "expect.toml").string() + ", or 'exposures' here");
  put("expect.toml", expect + "hdr_flip_exposures = [-1, 1, 2]\n");
  EXPECT_EQ(read(text).gates.at(0).metric, "hdr_flip");
}

TEST_F(GateSuiteFile, a_gate_may_give_parameters_of_its_metric_and_no_others) {
  const auto text = [&](const std::string& metric, const std::string& key) {
    return std::string(head) + scene_table +
           gate("engine = 'path'\nbudget = 'spp=16'\nmetric = '" + metric + "'\nbound = 0.1\n" + key);
  };
  put("expect.toml", "purpose = 'x'\nexposure = 3\n");
  const GateSuite suite = read(text("flip", "exposure = -2.5\n"));
  EXPECT_EQ(viewing_of(suite.scenes.at(0)).exposure, 3);
  EXPECT_EQ(parameters_of(suite.gates.at(0), viewing_of(suite.scenes.at(0))).exposure, -2.5);
  EXPECT_EQ(given_text(read(text("hdr_flip", "exposures = [-1, 0.5, 3]\n")).gates.at(0).parameters),
            "exposures=-1 0.5 3");
  EXPECT_TRUE(read(text("flip", "")).gates.at(0).parameters.empty());

  EXPECT_EQ(error(text("flip", "exposure = 65\n")), "g.toml:14:12: error: 'exposure': 65 is not from -64 to 64");
  EXPECT_EQ(error(text("flip", "exposure = '1'\n")),
            "g.toml:14:12: error: 'exposure' must be a finite number, not a string");
  EXPECT_EQ(
      error(text("hdr_flip", "exposures = [1, 2]\n")),
      "g.toml:14:13: error: 'exposures': expected a first and a last exposure from -64 to 64 and their number from "
      "1 to 100");
  for (const std::string metric : {"relmse", "bias", "agreement"})
    EXPECT_EQ(error(text(metric, "exposures = [1, 2, 3]\n")),
              "g.toml:14:13: error: 'exposures' is a parameter of hdr_flip; " + metric + " does not have it");
}

TEST_F(GateSuiteFile, the_suite_we_ship_is_valid_and_has_ten_scenes) {
  const GateSuite suite = read_gate_suite(std::string(PHOTONPROOF_SOURCE_DIR) + "/harness/suites/gates.toml");
  EXPECT_EQ(suite.scenes.size(), 10u);
  for (const SuiteScene& row : suite.scenes)
    EXPECT_TRUE(std::any_of(suite.gates.begin(), suite.gates.end(), [&](const Gate& gate) {
      return gate.scene == row.name;
    })) << row.name;
}

}  // namespace
}  // namespace photonproof::inline harness_gates
