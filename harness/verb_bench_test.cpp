// The program itself, as a user and a scheduler treat it: exit codes, Ctrl-C, kill -9.

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "harness/results.h"
#include "harness/test_suite.h"
#include "reference/process.h"

namespace photonproof {
namespace {

class BenchVerb : public FakeSuiteTest {
 protected:
  std::vector<std::string> argv(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{PHOTONPROOF_BINARY, "bench", folder_ / "suite.toml", "-o", folder_ / "out"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  ProcessOutcome bench(const std::vector<std::string>& more = {}) const {
    return run_process(argv(more), {.wall_limit_seconds = 60});
  }
  // Starts the program, sends it the signal once the engine "sleeps" runs, and waits; the status is wait's.
  int signalled_while_it_sleeps(int signal_number) const {
    const pid_t pid = fork();
    if (pid == 0) {
      std::vector<std::string> words = argv();
      std::vector<char*> pointers;
      pointers.reserve(words.size() + 1);
      for (std::string& word : words) pointers.push_back(word.data());
      pointers.push_back(nullptr);
      freopen("/dev/null", "w", stdout);
      freopen((folder_ / "stderr").c_str(), "w", stderr);
      execv(pointers[0], pointers.data());
      _exit(127);
    }
    for (int i = 0; i < 3000 && !has("pid"); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(pid, signal_number);
    int status = 0;
    waitpid(pid, &status, 0);
    return status;
  }
  std::size_t recorded() const { return read_results((folder_ / "out" / "results.json").string()).results.size(); }
};

TEST_F(BenchVerb, good_run_says_where_everything_is) {
  put("suite.toml", suite_text("grey", {"brighter", "refuses"}));
  const ProcessOutcome outcome = bench();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const std::string out = (folder_ / "out").string();
  EXPECT_EQ(outcome.standard_output,
            "fake: 3 cells measured, 0 kept from before; 2 ok, 1 unsupported\nresults: " + out +
                "/results.json\nreport: " + out + "/report.html\nreport: " + out + "/report.md\n");
  EXPECT_TRUE(has("out/report.html"));
  EXPECT_TRUE(has("out/report.md"));
  EXPECT_NE(outcome.standard_error.find("[1/3] scene/grey/spp=1000/seed=0 ok "), std::string::npos)
      << outcome.standard_error;
  EXPECT_NE(outcome.standard_error.find("scene/refuses/spp=1/seed=1 unsupported: no mirrors here\n"),
            std::string::npos);
}

TEST_F(BenchVerb, second_run_says_that_there_is_nothing_to_do) {
  put("suite.toml", suite_text("grey", {}));
  bench({"--no-report"});
  EXPECT_FALSE(has("out/report.html"));
  EXPECT_NE(bench({"--no-report"}).standard_output.find("nothing to run: every cell asked for has its result"),
            std::string::npos);
}

TEST_F(BenchVerb, failed_cell_is_exit_code_1_and_the_json_summary_counts_it) {
  put("suite.toml", suite_text("grey", {"fails"}));
  const ProcessOutcome outcome = bench({"--json", "--no-report"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.standard_output.find("\"crash\": 1"), std::string::npos) << outcome.standard_output;
}

TEST_F(BenchVerb, mistake_in_the_suite_is_exit_code_2_and_one_line) {
  put("suite.toml", "name = 'x'\n");
  const ProcessOutcome outcome = bench();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error, (folder_ / "suite.toml").string() + ":1:1: error: 'title' is missing\n");
  EXPECT_FALSE(has("out"));
}

TEST_F(BenchVerb, interrupt_is_exit_code_130_with_valid_results_and_the_next_run_goes_on) {
  put("suite.toml", suite_text("grey", {"sleeps"}));
  const int status = signalled_while_it_sleeps(SIGINT);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130) << get("stderr");
  EXPECT_EQ(recorded(), 1u);
  EXPECT_EQ(bench().exit_code, 0);
  EXPECT_EQ(recorded(), 2u);
  EXPECT_EQ(started(), "grey\nsleeps\nsleeps\n");
}

TEST_F(BenchVerb, killed_at_any_moment_leaves_valid_results_no_engine_and_no_lock) {
  put("suite.toml", suite_text("grey", {"sleeps"}));
  const int status = signalled_while_it_sleeps(SIGKILL);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(recorded(), 1u);
  const auto engine = static_cast<pid_t>(std::stol(get("pid")));
  const auto engine_runs = [&] {
    return run_process({"grep", "-q", "engine.sh", "/proc/" + std::to_string(engine) + "/cmdline"}).ok();
  };
  for (int i = 0; i < 200 && engine_runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(engine_runs());
  EXPECT_EQ(bench().exit_code, 0);
  EXPECT_EQ(recorded(), 2u);
}

}  // namespace
}  // namespace photonproof
