// The first verbs that one tries: lists, folders to begin with, the demo, and completion in shells.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs_start {
namespace {

namespace fs = std::filesystem;

class StartVerbs : public FolderTest {
 protected:
  /// `env` with variables and the program, in the test's folder.
  ProcessOutcome run(const std::vector<std::string>& arguments, const std::vector<std::string>& variables = {}) const {
    std::vector<std::string> argv{"env"};
    argv.insert(argv.end(), variables.begin(), variables.end());
    argv.push_back(PHOTONPROOF_BINARY);
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    return run_process(argv, {.wall_limit_seconds = 100, .working_folder = folder_});
  }
  nlohmann::json list(const std::string& verb) const {
    const ProcessOutcome outcome = run({verb, "--json"});
    EXPECT_TRUE(outcome.ok()) << outcome.standard_error;
    return nlohmann::json::parse(outcome.standard_output);
  }
  std::vector<std::string> names(const std::string& verb) const {
    std::vector<std::string> all;
    for (const auto& row : list(verb)) all.push_back(row["name"]);
    return all;
  }
  std::string bash(const std::string& script) const {
    return run_process({"bash", "-c", script}, {.wall_limit_seconds = 20, .working_folder = folder_}).standard_output;
  }
  /// A data folder with one small scene and a demo of one image.
  void put_small_data() const {
    for (const char* folder : {"data/scenes/library/cornell", "data/harness/suites"})
      fs::create_directories(folder_ / folder);
    const fs::path cornell = fs::path(PHOTONPROOF_SOURCE_DIR) / "scenes/library/cornell";
    fs::copy(cornell, folder_ / "data/scenes/library/cornell", fs::copy_options::recursive);
    put("data/harness/suites/demo.toml",
        "name = 'demo'\ntitle = 'Small'\n[[scene]]\nname = 'cornell'\n"
        "path = '../../scenes/library/cornell/scene.xml'\nwidth = 64\nheight = 64\n"
        "[[run]]\nengine = 'path'\nbudgets = ['spp=1']\nseeds = [1]\n");
  }
};

TEST_F(StartVerbs, list_what_the_source_tree_has) {
  const fs::path source = PHOTONPROOF_SOURCE_DIR;
  const auto scenes = list("scenes");
  std::size_t folders = 0;
  for (const char* shelf : {"scenes/library", "scenes/showcase"})
    for (const auto& entry : fs::directory_iterator(source / shelf)) folders += fs::exists(entry.path() / "scene.xml");
  EXPECT_EQ(scenes.size(), folders);
  for (const auto& scene : scenes) {
    EXPECT_TRUE(fs::exists(scene["path"].get<std::string>())) << scene;
    EXPECT_NE(scene["description"], "") << scene;
  }
  for (const auto& suite : list("suites")) EXPECT_TRUE(fs::exists(suite["path"].get<std::string>())) << suite;
  const auto has = [](const std::vector<std::string>& all, const char* name) { return std::ranges::count(all, name); };
  EXPECT_EQ(has(names("suites"), "first-light"), 1);
  EXPECT_EQ(has(names("metrics"), "relmse"), 1);
  EXPECT_EQ(has(names("engines"), "photonmapper"), 1);
}

TEST_F(StartVerbs, engines_that_are_not_installed_are_told_in_words) {
  // A PATH of its own, with what shell commands need and no other renderer.
  fs::create_directories(folder_ / "bin");
  for (const char* tool : {"sh", "grep"}) fs::create_symlink(fs::path("/bin") / tool, folder_ / "bin" / tool);
  const ProcessOutcome outcome = run({"engines"}, {"PATH=" + (folder_ / "bin").string() + ":"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  EXPECT_TRUE(std::regex_search(outcome.standard_output, std::regex("\npovray .*: not installed\n")))
      << outcome.standard_output;
  EXPECT_TRUE(std::regex_search(outcome.standard_output, std::regex("(^|\n)path .*: photonproof ")));
}

TEST_F(StartVerbs, init_writes_folders_whose_suites_run) {
  for (const char* kind : {"ci", "table", "course", "engine"}) {
    const ProcessOutcome outcome = run({"init", kind});
    ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
    const std::string folder = std::string("photonproof-") + kind;
    EXPECT_EQ(outcome.standard_output, folder + ": begin with README.md\n");
    EXPECT_TRUE(fs::exists(folder_ / folder / "README.md"));
  }
  const ProcessOutcome gate = run({"gate", "photonproof-ci/gates.toml", "-o", "gated", "--no-report"});
  EXPECT_EQ(gate.exit_code, 0) << gate.standard_output << gate.standard_error;
  const ProcessOutcome bench =
      run({"bench", "photonproof-table/table.toml", "-o", "benched", "--no-report", "--only", "cornell/path/spp=16/"});
  EXPECT_EQ(bench.exit_code, 0) << bench.standard_output << bench.standard_error;
  for (const char* part : {"handout/Makefile", "staff/config.h", "scenes/course-1.xml", "assignment.toml"})
    EXPECT_TRUE(fs::exists(folder_ / "photonproof-course" / part)) << part;
}

TEST_F(StartVerbs, init_leaves_what_is_there_and_nothing_half_written) {
  fs::create_directories(folder_ / "mine");
  put("mine/kept.txt", "kept");
  const ProcessOutcome taken = run({"init", "ci", "-o", "mine/"});
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_EQ(taken.standard_error, "mine: error: already exists: name another folder with -o\n");
  EXPECT_EQ(get("mine/kept.txt"), "kept");

  put_small_data();  // which lacks the templates
  const ProcessOutcome lacking = run({"init", "table", "-o", "new"}, {"PHOTONPROOF_DATA=data"});
  EXPECT_EQ(lacking.exit_code, 2);
  EXPECT_NE(lacking.standard_error, "");
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename();
    EXPECT_TRUE(name == "mine" || name == "data") << name;
  }
}

TEST_F(StartVerbs, demo_is_the_bench_of_the_data_folders_suite) {
  put_small_data();
  const ProcessOutcome outcome = run({"demo", "-o", "shown"}, {"PHOTONPROOF_DATA=data"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  EXPECT_NE(outcome.standard_output.find("report: shown/report.html"), std::string::npos) << outcome.standard_output;
  EXPECT_TRUE(fs::exists(folder_ / "shown/report.html"));
}

TEST_F(StartVerbs, a_wrong_data_folder_is_one_error) {
  const ProcessOutcome outcome = run({"scenes"}, {"PHOTONPROOF_DATA=nowhere"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error, "nowhere: error: lacks scenes/library or harness/suites (PHOTONPROOF_DATA)\n");
}

TEST_F(StartVerbs, the_program_alone_prints_what_there_is) {
  const ProcessOutcome outcome = run({});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_output, run({"--help"}).standard_output);
}

TEST_F(StartVerbs, bash_completes_verbs_subcommands_and_options) {
  put("complete.bash", run({"completions", "bash"}).standard_output);
  const auto completed = [&](const std::string& words) {
    return bash("source complete.bash; COMP_WORDS=(photonproof " + words +
                "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _photonproof; echo \"${COMPREPLY[@]}\"");
  };
  EXPECT_EQ(completed("rend"), "render\n");
  EXPECT_EQ(completed("generate mi"), "million\n");
  EXPECT_EQ(completed("generate million --tri"), "--triangles\n");
  EXPECT_EQ(completed("render scene.xml --checkp"), "--checkpoint\n");
  EXPECT_EQ(completed("render --tri"), "\n") << "an option of another verb";
  EXPECT_EQ(completed("decode"), "\n") << "a verb for the program itself";
}

TEST_F(StartVerbs, every_shell_has_every_verb) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = run({"completions", shell}).standard_output;
    for (const char* verb : {"demo", "render", "gate", "completions"}) {
      const std::regex alone("(^|[^-a-z])" + std::string(verb) + "([^-a-z]|$)");
      EXPECT_TRUE(std::regex_search(script, alone)) << shell << " lacks " << verb;
    }
    put("script", script);
    if (run_process({shell, "-c", ":"}).end == ProcessOutcome::End::not_started) continue;
    EXPECT_TRUE(run_process({shell, "-n", (folder_ / "script").string()}).ok()) << shell;
  }
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_start
