#include "harness/suites/engine_stats.h"

#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_suites {
namespace {

class StatsFile : public FolderTest {
 protected:
  EngineStats read(const std::string& text) const {
    put("stats.json", text);
    return read_engine_stats(folder_ / "stats.json");
  }
};

TEST_F(StatsFile, everything_known_is_taken_and_the_rest_ignored) {
  const EngineStats stats = read(R"({"schema_version": 1, "engine": "x", "phases": {"render": 1.5},
      "counts": {"rays": 1e9, "bias": -1}, "skipped": ["caustics: none"], "losses": ["blurred"], "more": [1]})");
  EXPECT_EQ(stats.phases, (std::map<std::string, double>{{"render", 1.5}}));
  EXPECT_EQ(stats.counts, (std::map<std::string, double>{{"bias", -1}, {"rays", 1e9}}));
  EXPECT_EQ(stats.skipped, (std::vector<std::string>{"caustics: none"}));
  EXPECT_EQ(stats.losses, (std::vector<std::string>{"blurred"}));
  EXPECT_FALSE(stats.problem.has_value());
}

TEST_F(StatsFile, denoiser_is_its_library_with_its_version) {
  const auto denoised = [&](const std::string& value) {
    return read("{\"schema_version\": 1, \"denoised\": " + value + "}");
  };
  EXPECT_EQ(denoised(R"({"library": "Some Denoiser", "version": "2.5.1", "biased": true})").denoised,
            "Some Denoiser 2.5.1");
  EXPECT_FALSE(denoised("null").denoised.has_value());
  EXPECT_FALSE(denoised("null").problem.has_value());
  EXPECT_FALSE(read(R"({"schema_version": 1})").denoised.has_value());
  for (const char* unclear : {"true", "{}", "{\"library\": 3}"}) {  // it may well be denoised
    EXPECT_TRUE(denoised(unclear).denoised.has_value()) << unclear;
    EXPECT_EQ(denoised(unclear).problem, "'denoised' names no library") << unclear;
  }
}

TEST_F(StatsFile, missing_file_is_no_problem) {
  const EngineStats stats = read_engine_stats(folder_ / "none.json");
  EXPECT_TRUE(stats.phases.empty());
  EXPECT_FALSE(stats.problem.has_value());
}

TEST_F(StatsFile, what_cannot_be_used_is_said_and_the_rest_kept) {
  EXPECT_EQ(read("{\"schema_version\": 1,").problem, "it is not valid JSON");
  EXPECT_EQ(read("[1]").problem, "it lacks \"schema_version\": 1");
  EXPECT_EQ(read("{\"phases\": {}}").problem, "it lacks \"schema_version\": 1");
  EXPECT_EQ(read("{\"schema_version\": 2}").problem, "it lacks \"schema_version\": 1");
  EXPECT_EQ(read("{\"schema_version\": 1, \"phases\": 3}").problem, "'phases' is not an object");
  EXPECT_EQ(read("{\"schema_version\": 1, \"skipped\": {}}").problem, "'skipped' is not an array");
  EXPECT_EQ(read("{\"schema_version\": 1, \"skipped\": [1]}").problem,
            "'skipped' holds something that is not a string");
  const EngineStats stats =
      read(R"({"schema_version": 1, "phases": {"a": 1, "b": -1}, "counts": {"c": null, "d": 2}})");
  EXPECT_EQ(stats.phases, (std::map<std::string, double>{{"a", 1}}));
  EXPECT_EQ(stats.counts, (std::map<std::string, double>{{"d", 2}}));
  EXPECT_EQ(stats.problem, "'counts' has no usable number for 'c'");
}

TEST_F(StatsFile, folder_in_its_place_is_said) {
  std::filesystem::create_directory(folder_ / "stats.json");
  const EngineStats stats = read_engine_stats(folder_ / "stats.json");
  EXPECT_EQ(stats.problem, (folder_ / "stats.json").string() + ": error: not a regular file");
}

}  // namespace
}  // namespace photonproof::inline harness_suites
