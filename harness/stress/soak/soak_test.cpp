// The program soaks itself for a short time. Programs that leak, leave files or change their images are found.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "harness/stress/soak/drift.h"
#include "harness/stress/soak/soak_run.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_stress_soak {
namespace {

using Json = nlohmann::ordered_json;

class Soak : public FolderTest {
 protected:
  /// `more` runs after every render: $n is its number, $image its EXR.
  ProcessOutcome soak_with(const std::string& more, const std::string& renders = "24") const {
    put("program", "#!/bin/sh\n" PHOTONPROOF_BINARY " \"$@\" || exit $?\nimage=$4\necho >>" +
                       (folder_ / "calls").string() + "\nn=$(wc -l <" + (folder_ / "calls").string() + ")\n" + more +
                       "\n");
    std::filesystem::permissions(folder_ / "program", std::filesystem::perms::owner_all);
    return soak({"--integrator", "path", "--bound", "100000", "--program", (folder_ / "program").string(), "--renders",
                 renders});
  }
  ProcessOutcome soak(const std::vector<std::string>& more) const {
    std::vector<std::string> argv{PHOTONPROOF_TRIALS, "soak", "-o", folder_ / "out"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 120});
  }
  Json record() const { return Json::parse(get("out/soak.json")); }
};

TEST_F(Soak, of_a_sound_program_is_flat_in_every_quantity_and_in_its_bits) {
  const ProcessOutcome outcome = soak({"--integrator", "path", "--bound", "1e6", "--renders", "40"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_output << outcome.standard_error;
  EXPECT_TRUE(outcome.standard_output.starts_with("flat: 40 renders by processes and 40 within one"))
      << outcome.standard_output;
  const Json json = record();
  ASSERT_EQ(json["series"].size(), 4u);
  for (const Json& series : json["series"]) {
    EXPECT_EQ(series["verdict"], "flat") << series;
    EXPECT_EQ(series["values"].size(), 10u) << series;  // 4 kinds a cycle: path does not render the medium
  }
  std::size_t refused = 0;
  for (const Json& kind : json["kinds"]) refused += kind.contains("refused") ? 1 : 0;
  EXPECT_EQ(refused, 1u);
}

TEST_F(Soak, finds_other_bits_and_a_file_that_was_not_there) {
  const ProcessOutcome outcome = soak_with("[ $n -lt 18 ] || { echo >>$image; echo >$image.left; }");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.standard_output;
  EXPECT_NE(outcome.standard_error.find("other bits than the first time"), std::string::npos) << outcome.standard_error;
  EXPECT_NE(outcome.standard_error.find(".exr.left: a file that was not there after the first cycle"),
            std::string::npos);
}

// A process beside the render's needs a megabyte more each time, and a file grows by a hundred bytes.
TEST_F(Soak, finds_memory_and_disk_that_grow) {
  const ProcessOutcome outcome = soak_with(
      "head -c $((80000000 + n * 1000000)) /dev/zero | tail -n 1 | wc -c >/dev/null\n"
      "head -c 100 /dev/zero >>$(dirname $image)/log",
      "32");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.standard_output;
  const Json json = record();
  EXPECT_EQ(json["series"][0]["verdict"], "grows") << json["series"][0];
  EXPECT_NEAR(json["series"][0]["growth_a_render"].get<double>(), 1e6, 2e5);
  EXPECT_EQ(json["series"][1]["verdict"], "grows") << json["series"][1];
  EXPECT_NEAR(json["series"][1]["growth_a_render"].get<double>(), 100, 10);
}

TEST_F(Soak, within_one_process_sees_what_is_not_given_back) {
  put("within.json",
      Json{{"cycles", 16}, {"renders", {{"a"}, {"b"}}}, {"images", {folder_ / "a", folder_ / "b"}}}.dump());
  static std::vector<void*> lost;
  soak_within(folder_, [&](const std::vector<std::string>& arguments) {
    lost.push_back(std::malloc(10000));
    put(arguments[0], "image");
  });
  for (void* block : lost) std::free(block);
  const Json samples = Json::parse(get("within-samples.json"));
  const auto heap = samples["heap"].get<std::vector<double>>();
  const Drift drift = drift_of(std::span(heap).subspan(4), 1000);
  EXPECT_EQ(drift.verdict, DriftVerdict::grows);
  EXPECT_NEAR(drift.slope, 20000, 1000);  // two renders a cycle
  EXPECT_FALSE(samples.contains("other_bits"));
}

// The program offers users only verbs about their engines.
TEST_F(Soak, is_no_verb_of_the_program) {
  for (const char* trial : {"soak", "faults"}) {
    const ProcessOutcome outcome = run_process({PHOTONPROOF_BINARY, trial, "-o", folder_ / "out"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.standard_error, "unknown verb '" + std::string(trial) + "'; photonproof --help lists all\n");
    EXPECT_EQ(outcome.standard_output, "");
    const ProcessOutcome help = run_process({PHOTONPROOF_BINARY, "--help"});
    EXPECT_EQ(help.standard_output.find(trial), std::string::npos) << help.standard_output;
  }
}

TEST_F(Soak, refuses_what_it_does_not_know_in_one_line) {
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--integrator", "nothing"}, {"--program", "nothing"}}) {
    const ProcessOutcome outcome = soak(wrong);
    EXPECT_EQ(outcome.exit_code, 2) << wrong[0];
    EXPECT_NE(outcome.standard_error.find("nothing"), std::string::npos) << outcome.standard_error;
  }
}

}  // namespace
}  // namespace photonproof::inline harness_stress_soak
