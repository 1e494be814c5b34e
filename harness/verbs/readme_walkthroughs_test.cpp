// The walkthroughs of README.md, as they are printed there: each fenced block under "Four walkthroughs" is run by bash
// in a folder of its own that has the scenes, with `photonproof` on the PATH.

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

#include "harness/sandbox/sandbox.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

const std::string source = PHOTONPROOF_SOURCE_DIR;

/// The commands of the block after the line that begins with `heading`.
std::string block_after(const std::string& heading) {
  const std::string readme = read_file(source + "/README.md");
  const std::size_t section = readme.find("\n## Four walkthroughs\n");
  const std::size_t at = readme.find("\n" + heading, section);
  const std::string fence = "\n```sh\n";
  const std::size_t begin = readme.find(fence, at);
  const std::size_t end = readme.find("\n```\n", begin + fence.size());
  if (section == std::string::npos || at == std::string::npos || begin == std::string::npos || end == std::string::npos)
    return {};
  return readme.substr(begin + fence.size(), end + 1 - begin - fence.size());
}

class Walkthrough : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    // The name on the PATH of a reader who followed the README's first section.
    fs::create_directory(folder_ / "bin");
    fs::create_symlink(PHOTONPROOF_BINARY, folder_ / "bin/photonproof");
    fs::create_directory_symlink(source + "/scenes", folder_ / "scenes");
    fs::create_directory_symlink(source + "/harness", folder_ / "harness");
  }

  ProcessOutcome run(const std::string& commands) const {
    put("block.sh", commands);
    ProcessOptions options;
    options.working_folder = folder_;
    options.wall_limit_seconds = 500;
    return run_process({"env", "PATH=" + (folder_ / "bin").string() + ":" + std::getenv("PATH"),
                        "PHOTONPROOF_CACHE=" + (folder_ / "cache").string(), "bash", "-eu", "block.sh"},
                       options);
  }
  std::string all_of(const ProcessOutcome& outcome) const {
    return outcome.sentence() + "\n" + outcome.standard_output + outcome.standard_error;
  }
};

TEST_F(Walkthrough, ci_job_passes_and_leaves_report_and_junit) {
  const ProcessOutcome outcome = run(block_after("**A CI job.**"));
  ASSERT_TRUE(outcome.ok()) << all_of(outcome);
  for (const char* file : {"cornell/reference-32x32.exr", "cornell/reference-32x32.json", "out/gate/results.json",
                           "out/gate/report.html", "out/gate/junit.xml"})
    EXPECT_TRUE(has(file)) << file;
  EXPECT_NE(get("out/gate/junit.xml").find("<testcase"), std::string::npos);
}

TEST_F(Walkthrough, authors_table_has_a_row_for_each_method) {
  const ProcessOutcome outcome = run(block_after("**An author's table.**"));
  ASSERT_TRUE(outcome.ok()) << all_of(outcome);
  const std::string table = get("table.tex");
  for (const char* text : {"\\toprule", "\\bottomrule", "path", "photon"})
    EXPECT_NE(table.find(text), std::string::npos) << text << "\n" << table;
  EXPECT_NE(get("table.csv").find("photonmapper"), std::string::npos);
}

TEST_F(Walkthrough, failure_is_found_and_can_be_looked_into) {
  // The build of the first walkthrough with a fault: it leaves out all light that is reflected more than once, a third
  // of what this scene has.
  const ProcessOutcome made = run(block_after("**A CI job.**"));
  ASSERT_TRUE(made.ok()) << all_of(made);
  std::string suite = get("gates.toml");
  const std::string engine = "engine = \"path\"";
  ASSERT_NE(suite.find(engine), std::string::npos);
  suite.replace(suite.find(engine), engine.size(), "engine = \"faulty\"");
  put("gates.toml", suite + R"(
[[engine]]
name = "faulty"
title = "faulty"
command = ["{photonproof}", "render", "{scene}", "--integrator", "direct", "-o", "{output}", "--stats", "{stats}",
  "--size", "{width}x{height}", "--seed", "{seed}", "--threads", "{threads}", "--checkpoint", "0", "{budget}"]
versions = [["{photonproof}", "--version"]]
budgets = ["spp"]
trust = "unbiased"
)");
  const ProcessOutcome outcome = run(block_after("**A failure.**"));
  ASSERT_TRUE(outcome.ok()) << all_of(outcome);
  EXPECT_NE(outcome.standard_output.find("exit code 1\n"), std::string::npos) << all_of(outcome);
  EXPECT_NE(outcome.standard_error.find("fail cornell: "), std::string::npos) << all_of(outcome);
  EXPECT_NE(outcome.standard_output.find("relmse"), std::string::npos) << all_of(outcome);
  // Too dark reads as too dark: the reference goes first.
  EXPECT_TRUE(std::regex_search(outcome.standard_output, std::regex("(^|\\n)bias +-"))) << all_of(outcome);
}

TEST_F(Walkthrough, class_is_graded_and_told_what_is_wrong) {
  if (const auto why = why_no_sandbox()) GTEST_SKIP() << *why;
  const ProcessOutcome outcome = run(block_after("**A class.**"));
  ASSERT_TRUE(outcome.ok()) << all_of(outcome);
  EXPECT_TRUE(std::regex_search(outcome.standard_output, std::regex("\nhonest,.*,right on"))) << all_of(outcome);
  EXPECT_TRUE(
      std::regex_search(outcome.standard_output, std::regex("\nwrong-upside-down,0,.*the image is upside down")))
      << all_of(outcome);
  for (const char* file : {"out/class/staff.html", "out/class/submissions/honest/page.html",
                           "out/class/submissions/wrong-upside-down/results.json"})
    EXPECT_TRUE(has(file)) << file;
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
