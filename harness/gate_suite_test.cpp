#include "harness/gate_suite.h"

#include <algorithm>

#include "scenes/test_folder.h"

namespace photonproof {
namespace {

constexpr const char* head = "name = 'tiny'\ntitle = 'Tiny'\n";
constexpr const char* scene = "[[scene]]\nname = 'a'\npath = 'a.xml'\nwidth = 8\nheight = 16\n";

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
      read(std::string(head) + "alpha = 0.01\nseeds = 4\nlooks = 3\n" + scene +
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

TEST_F(GateSuiteFile, mistakes_are_told_with_their_place) {
  const std::string front = std::string(head) + scene;
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
  EXPECT_NE(error(front + gate(good) + "blok_bound = 1\n").find("'blok_bound'"), std::string::npos);
}

TEST_F(GateSuiteFile, hdr_flip_is_bounded_only_where_the_scene_pins_its_exposures) {
  const std::string text =
      std::string(head) + scene + gate("engine = 'path'\nbudget = 'spp=16'\nmetric = 'hdr_flip'\nbound = 0.1\n");
  const std::string expect = "purpose = 'x'\nexposure = 0\n";
  put("expect.toml", expect);
  EXPECT_EQ(error(text),
            "g.toml:12:10: error: hdr_flip needs the scene to pin its exposures: 'hdr_flip_exposures' in " +
                (folder_ / "expect.toml").string());
  put("expect.toml", expect + "hdr_flip_exposures = [-1, 1, 2]\n");
  EXPECT_EQ(read(text).gates.at(0).metric, "hdr_flip");
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
}  // namespace photonproof
