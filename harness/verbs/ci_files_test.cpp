// The files under harness/ci that users copy are what their tools take them for, and their steps run; so does .ci/run.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string source = PHOTONPROOF_SOURCE_DIR;
const std::string ci = source + "/harness/ci/";

const std::string as_github_runs_it = "#!/usr/bin/env bash\nset -eo pipefail\n";

bool is_installed(const std::string& program) { return run_process({program, "--version"}).ok(); }

json workflow(const std::string& file = ci + "github-actions.yml") {
  const ProcessOutcome outcome = run_process(
      {"python3", "-c", "import json, sys, yaml; json.dump(yaml.load(open(sys.argv[1]), yaml.BaseLoader), sys.stdout)",
       file});
  EXPECT_TRUE(outcome.ok()) << outcome.standard_error;
  return json::parse(outcome.standard_output);
}

class CiFiles : public FolderTest {
 protected:
  /// The complaints about a script for bash; empty when there are none.
  std::string complaints(const std::string& script) const {
    put("script.sh", script);
    const ProcessOutcome outcome = run_process(
        {"shellcheck", "--exclude=SC1091", (folder_ / "script.sh").string()});  // it need not follow sources
    return outcome.ok() ? "" : outcome.sentence() + outcome.standard_output + outcome.standard_error;
  }
};

TEST_F(CiFiles, shell_scripts_have_no_complaints_of_shellcheck) {
  if (!is_installed("shellcheck")) GTEST_SKIP() << "no shellcheck here";
  EXPECT_EQ(complaints(read_file(ci + "gate.sh")), "");
  EXPECT_EQ(complaints(read_file(source + "/.ci/run")), "");
  EXPECT_NE(complaints("#!/bin/sh\nrm $1\n"), "");  // it would complain
}

// The test's repository has scripts that print their arguments.
TEST_F(CiFiles, ci_judges_every_suite_with_gates_and_fails_where_one_does) {
  const auto put_script = [&](const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    put(name, "#!/bin/sh\n" + text);
    fs::permissions(folder_ / name, fs::perms::owner_all);
  };
  put_script("check", "echo check\n");
  put_script("harness/setup/fuzz.sh", "echo fuzz \"$@\"\n");
  fs::create_directories(folder_ / "harness/suites");
  put("harness/suites/a.toml", "[[gate]]\n");
  put("harness/suites/b.toml", "[[gate]]\n");
  put("harness/suites/bench.toml", "[[run]]\n");
  fs::create_directories(folder_ / ".ci");
  fs::copy_file(source + "/.ci/run", folder_ / ".ci/run");
  const std::string gates =
      "check\ngate harness/suites/a.toml build/gates/a\ngate harness/suites/b.toml build/gates/b\n";
  for (const int gate_of_a : {0, 1, 3}) {
    put_script("harness/ci/gate.sh",
               "echo gate \"$@\"\ncase $1 in */a.toml) exit " + std::to_string(gate_of_a) + " ;; esac\n");
    const ProcessOutcome outcome = run_process({(folder_ / ".ci/run").string()});
    EXPECT_EQ(outcome.exit_code, gate_of_a);
    EXPECT_EQ(outcome.standard_output, gate_of_a == 0 ? gates + "fuzz --quick\n" : gates);
  }
}

TEST_F(CiFiles, workflow_is_one_that_github_reads) {
  if (!run_process({"python3", "-c", "import yaml"}).ok()) GTEST_SKIP() << "no python3-yaml here";
  const json file = workflow();
  for (const char* key : {"name", "on", "permissions", "env", "jobs"}) EXPECT_TRUE(file.contains(key)) << key;
  const json& job = file.at("jobs").at("gate");
  EXPECT_EQ(job.at("container"), "debian:12");  // the system that the project is tested on
  const bool shellcheck = is_installed("shellcheck");
  std::set<std::string> names;
  for (const json& step : job.at("steps")) {
    const std::string name = step.at("name");
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_NE(step.contains("run"), step.contains("uses")) << name << ": a step is one or the other";
    if (step.contains("run") && shellcheck) {
      EXPECT_EQ(complaints(as_github_runs_it + step.at("run").get<std::string>()), "") << name;
    }
  }
  // These steps run even after a gate failed.
  for (const json& step : job.at("steps"))
    if (step.at("name") == "Keep the report" || step.at("name") == "Summary") {
      EXPECT_EQ(step.at("if"), "always()");
    }
}

/// The steps of harness/ci/gate/action.yml by name.
std::map<std::string, json> action_steps() {
  const json action = workflow(ci + "gate/action.yml");
  EXPECT_EQ(action.at("runs").at("using"), "composite");
  std::map<std::string, json> steps;
  for (const json& step : action.at("runs").at("steps")) steps[step.at("name")] = step;
  return steps;
}

TEST_F(CiFiles, action_is_one_that_github_reads) {
  if (!run_process({"python3", "-c", "import yaml"}).ok()) GTEST_SKIP() << "no python3-yaml here";
  const std::map<std::string, json> steps = action_steps();
  for (const auto& [name, step] : steps) {
    EXPECT_NE(step.contains("run"), step.contains("uses")) << name;
    if (!step.contains("run")) continue;
    EXPECT_EQ(step.at("shell"), "bash") << name << ": a composite action's step names its shell";
    const std::string script = step.at("run");
    EXPECT_EQ(script.find("${{"), std::string::npos) << name << ": inputs reach scripts by the environment alone";
    if (is_installed("shellcheck")) {
      EXPECT_EQ(complaints(as_github_runs_it + script), "") << name;
    }
  }
  for (const char* name : {"Summary", "Keep the report"}) EXPECT_EQ(steps.at(name).at("if"), "always()") << name;
}

// The installed program is one that prints its arguments and fails as it is told.
TEST_F(CiFiles, action_gates_with_its_inputs_and_fails_as_the_gates_do) {
  if (!run_process({"python3", "-c", "import yaml"}).ok()) GTEST_SKIP() << "no python3-yaml here";
  fs::create_directories(folder_ / "photonproof/bin");
  put("photonproof/bin/photonproof", "#!/bin/sh\necho \"$@\"\nexit \"$CODE\"\n");
  fs::permissions(folder_ / "photonproof/bin/photonproof", fs::perms::owner_all);
  put("gate.sh", as_github_runs_it + action_steps().at("Gate").at("run").get<std::string>());
  const auto gate = [&](const char* code, const char* inconclusive_passes) {
    return run_process({"env", "RUNNER_TEMP=" + folder_.string(), std::string("CODE=") + code, "SUITE=a b.toml",
                        "FOLDER=out dir", "OPTIONS=--seed 7", std::string("INCONCLUSIVE_PASSES=") + inconclusive_passes,
                        "bash", (folder_ / "gate.sh").string()});
  };
  EXPECT_EQ(gate("0", "false").standard_output, "gate a b.toml -o out dir --seed 7\n");
  for (const char* code : {"0", "1", "2", "3"}) EXPECT_EQ(gate(code, "false").exit_code, std::stoi(code));
  EXPECT_EQ(gate("3", "true").exit_code, 0);
  EXPECT_EQ(gate("1", "true").exit_code, 1);
}

TEST_F(CiFiles, nightly_checks_are_commands_that_the_repository_has_and_shellcheck_takes) {
  if (!run_process({"python3", "-c", "import yaml"}).ok()) GTEST_SKIP() << "no python3-yaml here";
  const json job = workflow(source + "/.github/workflows/nightly.yml").at("jobs").at("check");
  std::set<std::string> scripts;
  for (const std::string command : job.at("strategy").at("matrix").at("command"))
    scripts.insert(command.substr(0, command.find(' ')));
  EXPECT_EQ(scripts.size(), 3u);
  for (const std::string& script : scripts) {
    const fs::path file = source + "/" + script;
    ASSERT_TRUE(fs::exists(file)) << file;
    EXPECT_NE(fs::status(file).permissions() & fs::perms::owner_exec, fs::perms::none) << file;
    if (is_installed("shellcheck")) {
      EXPECT_EQ(complaints(read_file(file)), "") << file;
    }
  }
  EXPECT_EQ(job.at("steps").back().at("if"), "always()");
}

TEST_F(CiFiles, workflow_builds_what_the_repository_has) {
  if (!run_process({"python3", "-c", "import yaml"}).ok()) GTEST_SKIP() << "no python3-yaml here";
  const std::string text = workflow().dump();
  for (const char* file : {"harness/setup/packages.sh", "harness/ci/gate.sh"}) {
    EXPECT_NE(text.find(std::string("photonproof/") + file), std::string::npos) << file;
    EXPECT_TRUE(fs::exists(source + "/" + file)) << file;
  }
  const json presets = json::parse(read_file(source + "/CMakePresets.json"));
  const auto& configure = presets.at("configurePresets");
  EXPECT_TRUE(std::any_of(configure.begin(), configure.end(), [](const json& p) { return p.at("name") == "release"; }));
}

TEST_F(CiFiles, shell_example_hands_its_arguments_to_the_gate_and_its_exit_code_on) {
  put("program", "#!/bin/sh\necho \"$@\"\nexit 3\n");
  fs::permissions(folder_ / "program", fs::perms::owner_all);
  const ProcessOutcome outcome = run_process({"env", "PHOTONPROOF_PROGRAM=" + (folder_ / "program").string(),
                                              ci + "gate.sh", "a b.toml", "out dir", "--seed", "7"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.standard_output, "gate a b.toml -o out dir --seed 7\n");
  const ProcessOutcome bare =
      run_process({"env", "PHOTONPROOF_PROGRAM=" + (folder_ / "program").string(), ci + "gate.sh"});
  EXPECT_EQ(bare.standard_output, "gate " + source + "/harness/suites/gates.toml -o out/gate\n");
}

TEST_F(CiFiles, shell_example_calls_a_build_that_fails_a_configuration_error) {
  // A repository without its CMake files: configuring fails, which must not look like a gate that failed (1).
  fs::create_directories(folder_ / "harness/ci");
  fs::create_directories(folder_ / "harness/setup");
  fs::copy_file(ci + "gate.sh", folder_ / "harness/ci/gate.sh");
  put("harness/setup/packages.sh",
      "build_packages=''\ninstall_packages() { :; }\nquietly() { echo \"no CMake files\" >&2; return 1; }\n");
  const ProcessOutcome outcome = run_process({(folder_ / "harness/ci/gate.sh").string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error, "no CMake files\n");  // once: the build stops at the first failure
}

// harness/packaging/container.sh builds and runs the image; it needs podman and a base.
TEST_F(CiFiles, container_file_installs_the_package_for_a_user_without_rights) {
  const std::string text = read_file(ci + "Containerfile");
  std::size_t at = 0;
  for (const char* line :
       {"harness/packaging/deb.sh\n", "ARG BASE=debian:12\nFROM ${BASE}\n", "COPY photonproof_*.deb /tmp/\n",
        "apt-get install -y --no-install-recommends /tmp/photonproof_*.deb", "useradd --create-home photonproof",
        "USER photonproof\n", "ENTRYPOINT [\"photonproof\"]\n"}) {
    at = text.find(line, at);
    ASSERT_NE(at, std::string::npos) << line;
  }
  for (const char* script : {"harness/packaging/deb.sh", "harness/packaging/container.sh"})
    EXPECT_TRUE(fs::exists(source + "/" + script)) << script;
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
