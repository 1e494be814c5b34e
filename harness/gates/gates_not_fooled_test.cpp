// Tests the program against engines that try to pass without rendering: the files they get and the signs that reveal
// them. Also tests that a missing image is told apart from a wrong one.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/gates/test_gates.h"
#include "reports/record/results.h"
#include "scenes/base/process.h"

namespace photonproof::inline harness_gates {
namespace {

namespace fs = std::filesystem;

class GatesNotFooled : public FakeGateTest {
 protected:
  void SetUp() override {
    FakeGateTest::SetUp();
    put_reference();
  }

  /// A row for an engine that is this shell script. The script has $scene, $output, $seed and $suite.
  std::string engine(const std::string& name, const std::string& lines, bool takes_seed = true) const {
    put(name + ".sh", "suite=$1 scene=$2 output=$3 seed=${4:-0}\n" + lines + "\n");
    return "[[engine]]\nname = '" + name +
           "'\ntitle = 'fake'\nbudgets = ['spp']\ntrust = 'unbiased'\ncommand = ['sh', " + "'{suite}/" + name +
           ".sh', '{suite}', '{scene}', '{output}'" + (takes_seed ? ", '{seed}'" : "") + "]\n";
  }
  ProcessOutcome run_gate(const std::string& rows, const std::vector<std::string>& more = {}) const {
    put("gates.toml", gates_text(rows));
    std::vector<std::string> argv{PHOTONPROOF_BINARY, "gate", folder_ / "gates.toml", "-o", folder_ / "out"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 60});
  }
  Results results() const { return read_results((folder_ / "out" / "results.json").string()); }
  GateRecord only_gate() const { return results().gates.at(0); }
};

TEST_F(GatesNotFooled, the_reference_is_not_beside_the_scene_that_an_engine_is_given) {
  put("texture.png", "not really");
  fs::create_directories(folder_ / "meshes");
  put("meshes/tree.ply", "not really");
  const std::string thief = engine("thief", R"(folder=$(dirname "$scene")
(cd "$folder" && ls -R) > "$suite/seen"
cp "$folder"/reference-32x24.exr "$output" || cp "$folder"/../references/scene.exr "$output" ||
cp "$(dirname "$output")/../../references/scene.exr" "$output")");
  for (int time : {1, 2}) {  // the second time, the first run's files are there
    EXPECT_EQ(run_gate(thief + gate("thief", "agreement", 0.05)).exit_code, 1) << time;
    EXPECT_EQ(only_gate().status, Status::crash) << only_gate().sentence;  // it has nothing to copy
  }
  const std::string seen = get("seen");
  for (const char* given : {"scene.xml", "texture.png", "tree.ply"}) EXPECT_NE(seen.find(given), std::string::npos);
  for (const char* hidden : {"reference-", "expect.toml", "results.json"})
    EXPECT_EQ(seen.find(hidden), std::string::npos);
  EXPECT_TRUE(has("out/references/scene.exr"));
  EXPECT_FALSE(has("out/.photonproof-scenes"));
}

TEST_F(GatesNotFooled, commands_and_last_words_are_about_the_scene_itself) {
  const std::string lost = engine("lost", "echo \"$scene:3:4: error: no such mesh\" >&2; exit 1");
  run_gate(lost + gate("lost", "agreement", 0.05));
  const std::string scene = (folder_ / "scene.xml").string();
  EXPECT_NE(only_gate().sentence.find(scene + ":3:4: error: no such mesh (crash)"), std::string::npos)
      << only_gate().sentence;
  EXPECT_NE(only_gate().command.find(" " + scene + " "), std::string::npos) << only_gate().command;
  EXPECT_EQ(only_gate().command.find("photonproof-scenes"), std::string::npos) << only_gate().command;
}

TEST_F(GatesNotFooled, an_image_that_is_the_reference_is_named) {
  const std::string knower = engine("knower", "cp \"$suite/reference-32x24.exr\" \"$output\"");
  for (const char* metric : {"agreement", "bias", "relmse"}) {
    const ProcessOutcome outcome = run_gate(knower + gate("knower", metric, 0.05));
    EXPECT_EQ(outcome.exit_code, 1) << metric;
    EXPECT_EQ(only_gate().sentence.rfind("an image is the reference itself, bit for bit", 0), 0u)
        << only_gate().sentence;
    EXPECT_NE(get("out/junit.xml").find("<failure type=\"fail\""), std::string::npos);
  }
}

TEST_F(GatesNotFooled, a_seed_that_is_not_heeded_is_the_first_thing_said) {
  const std::string fixed = engine("fixed", "cp \"$suite/good-7.exr\" \"$output\"");
  EXPECT_EQ(run_gate(fixed + gate("fixed", "agreement", 0.05)).exit_code, 1);
  EXPECT_EQ(only_gate().sentence.rfind("All 8 images are identical. The command probably ignores {seed}; 8 ", 0), 0u)
      << only_gate().sentence;
  EXPECT_TRUE(only_gate().tiles.empty());

  const std::string whitted = engine("whitted", "cp \"$suite/good-7.exr\" \"$output\"", false);
  EXPECT_EQ(run_gate(whitted + gate("whitted", "bias", 0.05)).exit_code, 3);
  EXPECT_EQ(only_gate().sentence.rfind("all 8 images are the same and the engine's command has no {seed}", 0), 0u);
  EXPECT_EQ(run_gate(whitted + gate("whitted", "relmse", 0.01)).exit_code, 0);
}

TEST_F(GatesNotFooled, no_image_and_a_wrong_image_are_told_apart) {
  const std::string rows = engine("crashes", "kill -SEGV $$") + engine("hangs", "sleep 60") +
                           engine("refuses", "echo 'no mirrors here' >&2; exit 3") +
                           engine("wrong", "cp \"$suite/dim-$((seed % 64)).exr\" \"$output\"") +
                           engine("infinite", "cp \"$suite/nan.exr\" \"$output\"");
  std::string gates;
  for (const char* name : {"crashes", "hangs", "refuses", "wrong", "infinite"}) gates += gate(name, "agreement", 0.05);
  put("gates.toml", "");
  std::string text = gates_text(rows + gates);
  text.replace(text.find("seconds = 20"), 12, "seconds = 1");
  put("gates.toml", text);
  const ProcessOutcome outcome =
      run_process({PHOTONPROOF_BINARY, "gate", folder_ / "gates.toml", "-o", folder_ / "out", "--json"},
                  {.wall_limit_seconds = 60});
  EXPECT_EQ(outcome.exit_code, 1);
  const Results all = results();
  ASSERT_EQ(all.gates.size(), 5u);
  EXPECT_EQ(all.gates[0].status, Status::crash);
  EXPECT_EQ(all.gates[1].status, Status::timeout);
  EXPECT_EQ(all.gates[2].status, Status::unsupported);
  EXPECT_EQ(all.gates[2].verdict, GateVerdict::inconclusive);
  EXPECT_FALSE(all.gates[3].status.has_value());
  EXPECT_EQ(all.gates[4].status, Status::bad_image);
  EXPECT_EQ(nlohmann::json::parse(outcome.standard_output).at("gates").at(1).at("status"), "timeout");
  const std::string junit = get("out/junit.xml");
  for (const char* element : {"<error type=\"crash\"", "<error type=\"timeout\"", "<skipped type=\"unsupported\"",
                              "<failure type=\"fail\"", "<failure type=\"bad_image\""})
    EXPECT_NE(junit.find(element), std::string::npos) << element;
  EXPECT_NE(junit.find("tests=\"5\" failures=\"2\" errors=\"2\" skipped=\"1\""), std::string::npos) << junit;
}

TEST_F(GatesNotFooled, an_engine_that_cannot_be_started_is_the_suites_mistake_and_the_others_are_decided) {
  const std::string missing =
      "[[engine]]\nname = 'missing'\ntitle = 'fake'\nbudgets = ['spp']\ntrust = 'unbiased'\n"
      "command = ['bin/mine', '{scene}', '{output}', '{seed}']\n";
  const ProcessOutcome outcome =
      run_gate(missing + gate("missing", "agreement", 0.05) + gate("dim", "agreement", 0.05));
  EXPECT_EQ(outcome.exit_code, 2);
  const Results all = results();
  ASSERT_EQ(all.gates.size(), 2u);
  EXPECT_EQ(all.gates[0].status, Status::not_started);
  EXPECT_NE(all.gates[0].sentence.find("bin/mine': No such file or directory; a relative program starts from the "
                                       "suite's folder, {suite}: '" +
                                       folder_.string() + "'"),
            std::string::npos)
      << all.gates[0].sentence;
  EXPECT_EQ(all.gates[1].verdict, GateVerdict::fail);
  EXPECT_NE(get("out/junit.xml").find("<error type=\"not_started\""), std::string::npos);
}

TEST_F(GatesNotFooled, relative_programs_start_from_the_suites_folder) {
  fs::create_directories(folder_ / "bin");
  put("bin/mine", "#!/bin/sh\ncp \"$1/good-$(($3 % 64)).exr\" \"$2\"\n");
  fs::permissions(folder_ / "bin/mine", fs::perms::owner_all);
  const std::string mine =
      "[[engine]]\nname = 'mine'\ntitle = 'fake'\nbudgets = ['spp']\ntrust = 'unbiased'\n"
      "command = ['bin/mine', '{suite}', '{output}', '{seed}', '{scene}']\nversions = [['bin/mine', '.', "
      "'/dev/null']]\n";
  put("bin/version", "#!/bin/sh\necho 1\n");
  fs::permissions(folder_ / "bin/version", fs::perms::owner_all);
  std::string rows = mine + gate("mine", "agreement", 0.05);
  rows.replace(rows.find("[['bin/mine', '.', '/dev/null']]"), 32, "[['bin/version']]");
  const ProcessOutcome outcome = run_gate(rows);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
}

TEST_F(GatesNotFooled, a_file_beside_the_suite_that_a_command_names_without_suite_is_hinted_at) {
  put("render.sh", "exit 0\n");
  const std::string row =
      "[[engine]]\nname = 'script'\ntitle = 'fake'\nbudgets = ['spp']\ntrust = 'unbiased'\n"
      "command = ['sh', 'render.sh', '{scene}', '{output}', '{seed}']\n";
  run_gate(row + gate("script", "agreement", 0.05));
  EXPECT_NE(only_gate().sentence.find("; for the 'render.sh' beside the suite write {suite}/render.sh"),
            std::string::npos)
      << only_gate().sentence;
}

TEST_F(GatesNotFooled, an_engine_may_have_a_file_and_a_name_of_each_scene) {
  put("scene.own", "my format");
  const std::string own =
      "[[engine]]\nname = 'own'\ntitle = 'fake'\nbudgets = ['spp']\ntrust = 'unbiased'\n"
      "command = ['sh', '{suite}/own.sh', '{suite}', '{scene}', '{output}', '{seed}', 'called {scene_name}']\n";
  put("own.sh", "cp \"$2\" \"$1/read\"; echo \"$5\" > \"$1/name\"; cp \"$1/good-$(($4 % 64)).exr\" \"$3\"\n");
  std::string text = gates_text(own + gate("own", "agreement", 0.05));
  text.insert(text.find("path = 'scene.xml'"), "files = {own = 'scene.own'}\n");
  put("gates.toml", text);
  const ProcessOutcome outcome =
      run_process({PHOTONPROOF_BINARY, "gate", folder_ / "gates.toml", "-o", folder_ / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_EQ(get("read"), "my format");
  EXPECT_EQ(get("name"), "called scene\n");
}

TEST_F(GatesNotFooled, engines_are_set_against_each_other_when_all_gates_are_decided) {
  const ProcessOutcome outcome = run_gate(
      "[[gate]]\nscene = 'scene'\nengine = ['good', 'dim']\nbudget = 'spp=64'\nmetric = 'agreement'\nbound = 0.05\n");
  EXPECT_EQ(outcome.exit_code, 1);
  const std::string together = "scene: dim fails where good passes: other gates pass with the same reference";
  EXPECT_EQ(outcome.standard_output.rfind("fake: 1 pass, 1 fail, 0 inconclusive\ntogether: " + together + "\n", 0), 0u)
      << outcome.standard_output;
  EXPECT_EQ(results().findings, std::vector<std::string>{together});
  EXPECT_NE(get("out/report.html").find(together), std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline harness_gates
