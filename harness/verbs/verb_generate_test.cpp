// photonproof generate, as a user calls it.
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

class GenerateVerb : public FolderTest {
 protected:
  ProcessOutcome generate(const std::string& triangles, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY,   "generate", "million", "--triangles", triangles, "-o",
                                  folder_ / "made/here"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 20});
  }
};

TEST_F(GenerateVerb, makes_the_folder_and_says_what_is_in_it) {
  const ProcessOutcome outcome = generate("1e4");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_EQ(outcome.standard_output,
            (folder_ / "made/here/scene.xml").string() + ": 10004 triangles; 100 rocks of 20 triangles each\n");
  for (const char* file : {"scene.xml", "expect.toml", "terrain.ply", "rocks.ply"})
    EXPECT_TRUE(has("made/here/" + std::string(file))) << file;
}

TEST_F(GenerateVerb, overwrites_only_when_forced) {
  ASSERT_EQ(generate("1000").exit_code, 0);
  const std::string before = get("made/here/terrain.ply");
  const ProcessOutcome refused = generate("2000");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.standard_error,
            (folder_ / "made/here/scene.xml").string() + ": error: already exists (--force overwrites it)\n");
  EXPECT_EQ(get("made/here/terrain.ply"), before);
  EXPECT_EQ(generate("2000", {"--force"}).exit_code, 0);
  EXPECT_NE(get("made/here/terrain.ply"), before);
}

TEST_F(GenerateVerb, refuses_other_counts) {
  for (const char* count : {"999", "10000001", "1e8", "1000.5", "many", "-1e4", "nan", "1e4 "}) {
    const ProcessOutcome outcome = generate(count);
    EXPECT_EQ(outcome.exit_code, 2) << count;
    EXPECT_EQ(outcome.standard_error,
              "--triangles: error: '" + std::string(count) + "' is not a whole number from 1e3 to 1e7\n");
  }
  EXPECT_FALSE(has("made"));
}

TEST_F(GenerateVerb, writes_showcase_at_the_detail_that_is_asked_for) {
  const auto showcase = [&](const char* detail, const char* folder) {
    return run_process({PHOTONPROOF_BINARY, "generate", "showcase", "--detail", detail, "-o", folder_ / folder},
                       {.wall_limit_seconds = 60});
  };
  const ProcessOutcome coarse = showcase("0.25", "coarse");
  EXPECT_EQ(coarse.exit_code, 0) << coarse.standard_error;
  EXPECT_NE(coarse.standard_output.find((folder_ / "coarse/gallery/knot.ply").string() + "\n"), std::string::npos);
  EXPECT_EQ(showcase("1", "stored").exit_code, 0);
  EXPECT_EQ(get("stored/foggy-stage/prism.ply"), get("coarse/foggy-stage/prism.ply"));
  const double sizes = static_cast<double>(get("stored/gallery/knot.ply").size()) /
                       static_cast<double>(get("coarse/gallery/knot.ply").size());
  EXPECT_NEAR(sizes, 4, 0.4);
  EXPECT_EQ(showcase("1", "stored").exit_code, 2) << "the files are there";
  EXPECT_EQ(showcase("0", "none").exit_code, 2);
  EXPECT_FALSE(has("none"));
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
