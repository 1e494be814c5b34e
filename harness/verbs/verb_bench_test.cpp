// The program itself, as a user and a scheduler treat it: exit codes, Ctrl-C, kill -9.

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "harness/cells/test_program.h"
#include "harness/suites/test_suite.h"
#include "reports/record/results.h"
#include "scenes/base/process.h"

namespace photonproof::inline harness_verbs {
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
  pid_t start_bench() const { return start_program(argv(), folder_ / "stderr"); }
  // Starts the program, sends it the signal once the engine "sleeps" runs, and waits; the status is wait's.
  int signalled_while_it_sleeps(int signal_number) const {
    const pid_t pid = start_bench();
    for (int i = 0; i < 3000 && (!has("pid") || get("pid").empty()); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(pid, signal_number);
    int status = 0;
    waitpid(pid, &status, 0);
    return status;
  }
  // Kills it so long after `when` is true.
  void killed_after(const std::function<bool()>& when, std::chrono::milliseconds delay) const {
    const pid_t pid = start_bench();
    for (int i = 0; i < 3000 && !when(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(delay);
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }
  std::size_t recorded() const { return read_results((folder_ / "out" / "results.json").string()).results.size(); }
};

TEST_F(BenchVerb, good_run_says_where_everything_is) {
  put("suite.toml", suite_text("grey", {"brighter", "refuses"}));
  const ProcessOutcome outcome = bench();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const std::string out = (folder_ / "out").string();
  const std::string start =
      "fake: 3 images measured, 0 kept from before; 2 finished, 1 unsupported\n"
      "\n"
      "scene  engine    budget  verdict    relMSE  seconds\n"
      "scene  brighter  1 spp   unknown  0.0385 †  ";
  EXPECT_TRUE(outcome.standard_output.starts_with(start)) << outcome.standard_output;
  const std::string end =
      "\n\nscene, brighter: declared by the engine: it only copies\nscene: † the reference is by grey, which nothing "
      "vouches for: these numbers say how far from it an image "
      "is, "
      "not how wrong\nresults: " +
      out + "/results.json\nreport: " + out + "/report.html\nreport: " + out + "/report.md\n";
  EXPECT_TRUE(outcome.standard_output.ends_with(end)) << outcome.standard_output;
  EXPECT_TRUE(has("out/report.html"));
  EXPECT_TRUE(has("out/report.md"));
  EXPECT_NE(outcome.standard_error.find("[1/3] scene/grey/spp=1000/seed=0 finished "), std::string::npos)
      << outcome.standard_error;
  EXPECT_NE(outcome.standard_error.find("scene/refuses/spp=1/seed=1 unsupported: no mirrors here\n"),
            std::string::npos);
}

TEST_F(BenchVerb, closed_standard_streams_do_not_reach_its_files) {
  put("suite.toml", suite_text("grey", {}));
  std::string command;
  for (const std::string& part : argv({"--no-report"})) command += "'" + part + "' ";
  EXPECT_EQ(run_process({"sh", "-c", command + "<&- >&- 2>&-"}, {.wall_limit_seconds = 60}).exit_code, 0);
  const ProcessOutcome again = bench({"--no-report"});
  EXPECT_EQ(again.exit_code, 0) << again.standard_error;
  EXPECT_NE(again.standard_output.find("nothing to run"), std::string::npos) << again.standard_output;
}

TEST_F(BenchVerb, second_run_says_that_there_is_nothing_to_do) {
  put("suite.toml", suite_text("grey", {}));
  bench({"--no-report"});
  EXPECT_FALSE(has("out/report.html"));
  EXPECT_NE(bench({"--no-report"}).standard_output.find("nothing to run: every image asked for has its result"),
            std::string::npos);
}

TEST_F(BenchVerb, hdr_flip_at_pinned_exposures_is_that_of_compare_at_the_same_exposures) {
  put("suite.toml", suite_text("grey", {"brighter"}));
  put("expect.toml", get("expect.toml") + "hdr_flip_exposures = [-1.5, 2.25, 4]\n");
  ASSERT_EQ(bench({"--no-report"}).exit_code, 0);
  const Results results = read_results((folder_ / "out" / "results.json").string());
  const auto image = [&](const std::string& cell) { return folder_ / "out" / results.find(cell)->image; };
  const std::string brighter = "scene/brighter/spp=1/seed=1";
  const ProcessOutcome compared =
      run_process({PHOTONPROOF_BINARY, "compare", image("scene/grey/spp=1000/seed=0"), image(brighter), "--metrics",
                   "hdr_flip", "--exposures", "-1.5", "2.25", "4", "--json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.standard_error;
  const nlohmann::json expected = nlohmann::json::parse(compared.standard_output).at("metrics").at(0);
  const std::vector<MetricValue>& metrics = results.find(brighter)->metrics;
  const auto found = std::ranges::find_if(metrics, [](const MetricValue& metric) { return metric.name == "hdr_flip"; });
  ASSERT_NE(found, metrics.end());
  EXPECT_EQ(found->value, expected.at("value").get<double>());
  EXPECT_EQ(found->parameters, expected.at("parameters").get<std::string>());
}

// The images are a crop with its place as ours are, one of the crop's size, and one of the whole film that is bright
// outside of the crop. Judged with the black around it, the crop's errors are a quarter of these.
TEST_F(BenchVerb, errors_of_a_scene_with_a_crop_are_those_of_the_crop_by_hand) {
  put_cropped_scene();
  Image reference(width, height), test(width, height), surrounded(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const bool inside = x >= 8 && x < 24 && y >= 6 && y < 18;
        reference.pixel(x, y)[c] = 0.2f + 0.01f * static_cast<float>(x) + 0.02f * static_cast<float>(y);
        test.pixel(x, y)[c] = reference.pixel(x, y)[c] + 0.01f * static_cast<float>(x + c);
        surrounded.pixel(x, y)[c] = inside ? test.pixel(x, y)[c] : 9.0f;
      }
  const Rendering part = crop_of_scene(test);
  write_exr(folder_ / "grey.exr", crop_of_scene(reference));
  write_exr(folder_ / "brighter.exr", part);
  write_exr(folder_ / "small.exr", {.mean = part.mean, .variance = {}, .metadata = {}});
  write_exr(folder_ / "nan.exr", {.mean = surrounded, .variance = {}, .metadata = {}});
  put("suite.toml", suite_text("grey", {"brighter", "small", "nan"}));
  const ProcessOutcome outcome = bench({"--no-report"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const Image expected = crop_of_scene(reference).mean;
  const double mse = error_by_hand(expected, part.mean, {}), relmse = error_by_hand(expected, part.mean, 0.01);
  const Results results = read_results((folder_ / "out" / "results.json").string());
  EXPECT_EQ(std::pair(results.scenes.at(0).width, results.scenes.at(0).height), std::pair(16, 12));
  for (const char* engine : {"brighter", "small", "nan"}) {
    const Result* result = results.find("scene/" + std::string(engine) + "/spp=1/seed=1");
    std::map<std::string, double> values;
    for (const MetricValue& metric : result->metrics) values[metric.name] = metric.value;
    EXPECT_NEAR(values["mse"], mse, 1e-7 * mse) << engine;
    EXPECT_NEAR(values["relmse"], relmse, 1e-7 * relmse) << engine;
    const auto curve = std::ranges::find(results.convergence, engine, &Convergence::engine);
    ASSERT_NE(curve, results.convergence.end()) << engine;
    EXPECT_NEAR(curve->points.at(0).relmse->value, relmse, 1e-6 * relmse) << engine;
    const Image picture = read_image(folder_ / "out" / result->pictures.at("error"));
    EXPECT_EQ(std::pair(picture.width, picture.height), std::pair(16, 12)) << engine;
  }
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
  EXPECT_EQ(started(), "grey\nsleeps\nsleeps\n");
}

// Ten runs are killed wherever they happen to be, starting up, measuring, writing or comparing; the eleventh finishes.
TEST_F(BenchVerb, killed_at_ten_random_moments_never_repeats_a_finished_cell_nor_damages_the_record) {
  put("slow.sh", "echo $1 >> \"$2/starts\"; sleep 0.05; cp \"$2/grey.exr\" \"$3\"\n");
  std::string text = suite_text("grey", {}) +
                     "[[engine]]\nname = 'slow'\ntitle = 'slow'\nbudgets = ['spp']\ntrust = 'external'\n"
                     "command = ['sh', '{suite}/slow.sh', '{seed}', '{suite}', '{output}', '{scene}']\n"
                     "[[run]]\nengine = 'slow'\nbudgets = ['spp=1']\nseeds = [";
  for (int seed = 1; seed <= 40; ++seed) text += std::to_string(seed) + ",";
  put("suite.toml", text + "]\n");
  const auto starts = [&] { return has("starts") ? get("starts") : std::string(); };
  const auto finished = [&] {
    std::set<std::string> seeds;
    if (!has("out/cells")) return seeds;
    for (const auto& cell : std::filesystem::directory_iterator(folder_ / "out" / "cells"))
      if (std::filesystem::exists(cell.path() / "cell.json")) {
        const Result result = read_result((cell.path() / "cell.json").string()).result;
        if (result.cell.engine == "slow") seeds.insert(std::to_string(result.cell.seed));
      }
    return seeds;
  };
  std::mt19937 generator(1);
  std::size_t most_finished = 0;
  for (int run = 0; run < 11; ++run) {
    const std::set<std::string> before = finished();
    most_finished = std::max(most_finished, before.size());
    const std::size_t started_before = starts().size();
    // Every other one while it starts, however long that takes here, the others among its cells.
    const auto measures = [&] { return run % 2 == 0 || starts().size() > started_before; };
    if (run < 10)
      killed_after(measures, std::chrono::milliseconds(generator() % 600));
    else
      EXPECT_EQ(bench({"--no-report"}).exit_code, 0);
    if (has("out/results.json")) {
      EXPECT_NO_THROW(recorded());
    }
    std::istringstream now(starts().substr(started_before));
    for (std::string seed; now >> seed;) EXPECT_EQ(before.count(seed), 0u) << "seed " << seed << " again";
  }
  EXPECT_GT(most_finished, 0u);
  EXPECT_EQ(finished().size(), 40u);
  EXPECT_EQ(recorded(), 41u);
}

TEST_F(BenchVerb, against_says_by_its_exit_code_what_it_found) {
  const auto program = [&](const std::string& name, int count) {
    put(name, "#!/bin/sh\ni=0; while [ $i -lt " + std::to_string(count) + " ]; do i=$((i+1)); done\ncp " +
                  (folder_ / "grey.exr").string() + " \"$2\"\n");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
    return (folder_ / name).string();
  };
  put("suite.toml", suite_text("grey", {}) +
                        "[[engine]]\nname = 'ours'\ntitle = 'ours'\nbudgets = ['spp']\ntrust = 'external'\n"
                        "command = ['{photonproof}', '{scene}', '{output}']\n"
                        "[[run]]\nengine = 'ours'\nbudgets = ['spp=1']\nseeds = [1]\n");
  const std::string fast = program("fast", 20000), slow = program("slow", 40000);
  const std::string old_results = (folder_ / "old.json").string();
  ASSERT_EQ(bench({"--no-report", "--program", fast}).exit_code, 0);
  std::filesystem::copy_file(folder_ / "out" / "results.json", old_results);
  const std::vector<std::string> against{"--no-report", "--against", old_results, "--slower", "20"};
  const auto compared = [&](std::vector<std::string> more) {
    more.insert(more.begin(), against.begin(), against.end());
    return bench(more).exit_code;
  };
  EXPECT_EQ(compared({"--program", slow, "--old-program", fast}), 1);
  EXPECT_EQ(compared({"--program", fast, "--old-program", slow}), 0);
  EXPECT_EQ(compared({"--program", slow, "--old-program", fast, "--against-rounds", "2"}), 3);
  EXPECT_EQ(compared({"--program", slow, "--old-program", (folder_ / "gone").string()}), 2);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
