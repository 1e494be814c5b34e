#include "harness/bench/bench.h"

#include "harness/bench/bench_findings.h"
#include "harness/gates/test_gates.h"

namespace photonproof::inline harness_bench {
namespace {

class Silent : public BenchObserver {
 public:
  void starts(std::size_t, std::size_t, const Cell&) override {}
  void ended(std::size_t number, std::size_t total, const Result& result) override {
    seen += std::to_string(number) + "/" + std::to_string(total) + " " + result.cell.engine + "\n";
    if (after_each) after_each();
  }
  std::string seen;
  std::function<void()> after_each;
};

class BenchRun : public FakeSuiteTest {
 protected:
  void SetUp() override {
    FakeSuiteTest::SetUp();
    options_.results_folder = folder_ / "out";
    options_.program = "/bin/true";
    options_.command = "bench fake";
    options_.versions = {{"test", "1"}};
    options_.comparison_version = "1";
    options_.interrupt = &interrupt_;
  }
  BenchSummary run(const std::string& text) {
    put("suite.toml", text);
    return run_bench(read_suite(folder_ / "suite.toml"), options_, observer_);
  }
  Results results() const { return read_results((folder_ / "out" / "results.json").string()); }
  Result result_of(const std::string& engine) const {
    for (const Result& result : results().results)
      if (result.cell.engine == engine) return result;
    throw std::out_of_range(engine);
  }
  static double metric(const Result& result, const std::string& name) {
    for (const MetricValue& value : result.metrics)
      if (value.name == name) return value.value;
    throw std::out_of_range(name);
  }
  void forget_log() const { std::filesystem::remove(folder_ / "log"); }

  BenchOptions options_;
  Silent observer_;
  std::atomic<bool> interrupt_ = false;
};

TEST_F(BenchRun, reference_runs_first_and_the_others_are_compared_with_it) {
  const BenchSummary summary = run(suite_text("grey", {"brighter"}));
  EXPECT_EQ(started(), "grey\nbrighter\n");
  EXPECT_EQ(observer_.seen, "1/2 grey\n2/2 brighter\n");
  EXPECT_EQ(summary.measured, 2u);
  EXPECT_EQ(summary.kept, 0u);
  EXPECT_EQ(summary.missing, 0u);
  EXPECT_FALSE(summary.interrupted);
  EXPECT_EQ(summary.by_status.at(Status::ok), 2u);

  const Results record = results();
  EXPECT_EQ(record.suite, "fake");
  EXPECT_EQ(record.command, "bench fake");
  EXPECT_EQ(record.versions.at("test"), "1");
  ASSERT_EQ(record.scenes.size(), 1u);
  EXPECT_EQ(record.scenes[0].purpose, "to be measured");
  EXPECT_EQ(record.scenes[0].exposure, 0.5);
  EXPECT_EQ(record.scenes[0].reference_label, "scene/grey/spp=1000/seed=0");
  ASSERT_EQ(record.engines.size(), 2u);  // only those in use
  EXPECT_EQ(record.engines[0].version, "fake 1");
  EXPECT_EQ(record.engines[0].trust, "external");

  const Result reference = result_of("grey"), other = result_of("brighter");
  EXPECT_TRUE(reference.metrics.empty());
  EXPECT_EQ(reference.pictures.size(), 1u);
  // All values are 0.6, the reference's 0.5: mse is (0.1)^2.
  EXPECT_NEAR(metric(other, "mse"), 0.01, 1e-6);
  for (const char* role : {"image", "flip", "error"}) EXPECT_TRUE(has("out/" + other.pictures.at(role))) << role;
  EXPECT_TRUE(has("out/" + other.image));
  EXPECT_EQ(other.engine_version, "fake 1");
  ASSERT_TRUE(other.calibration && reference.calibration);
  EXPECT_EQ(other.calibration->threads, 1);
}

// The kernel here may count or not: the record has counts, or says that there are none.
TEST_F(BenchRun, record_has_instruction_counts_or_says_that_the_kernel_has_none) {
  run(suite_text("grey", {"brighter"}));
  const Results record = results();
  const bool counted = result_of("brighter").instructions.has_value() || result_of("grey").instructions.has_value();
  EXPECT_EQ(record.versions.contains("instructions"), !counted);
}

TEST(BenchFindings, absent_instruction_counts_are_told_of_finished_cells_alone) {
  Results made;
  note_absent_instructions(made);
  EXPECT_FALSE(made.versions.contains("instructions"));
  made.results.resize(2);
  made.results[0].status = Status::crash;
  made.results[1].instructions = 1000;
  note_absent_instructions(made);
  EXPECT_FALSE(made.versions.contains("instructions"));
  made.results[1].instructions.reset();
  note_absent_instructions(made);
  EXPECT_EQ(made.versions["instructions"], "not counted by this kernel");
}

TEST_F(BenchRun, second_run_measures_nothing_and_changes_no_byte) {
  const std::string text = suite_text("grey", {"brighter", "fails"});
  run(text);
  const std::string before = get("out/results.json");
  forget_log();
  const BenchSummary summary = run(text);
  EXPECT_EQ(started(), "");
  EXPECT_EQ(summary.measured, 0u);
  EXPECT_EQ(summary.kept, 3u);
  EXPECT_EQ(get("out/results.json"), before);
}

TEST_F(BenchRun, every_failure_is_a_result_and_the_run_goes_on) {
  const BenchSummary summary = run(suite_text(
      "grey", {"hangs", "segfaults", "fails", "refuses", "silent", "half", "small", "nan", "garbage", "brighter"},
      "seconds = 1"));
  EXPECT_EQ(summary.by_status, (std::map<Status, std::size_t>{{Status::ok, 2},
                                                              {Status::timeout, 1},
                                                              {Status::crash, 2},
                                                              {Status::bad_image, 5},
                                                              {Status::unsupported, 1}}));
  EXPECT_EQ(result_of("small").detail, "wrote 4x4 pixels instead of 32x24");
  EXPECT_TRUE(result_of("small").metrics.empty());
  EXPECT_TRUE(result_of("nan").metrics.empty());
  EXPECT_FALSE(result_of("brighter").metrics.empty());
}

// Three cells of 0.6 against a reference of 0.5 are one curve point: relmse = 0.01 / 0.26. The three images are equal,
// so they count once. One image gives neither bias nor variance.
TEST_F(BenchRun, conclusions_are_in_the_record_and_the_control_is_measured_apart) {
  const std::string text = suite_text("grey", {}) +
                           "[[run]]\nengine = 'brighter'\nbudgets = ['spp=1']\nseeds = [1, 2, 3]\n"
                           "[bench]\ncontrol = 'brighter'\n";
  // One reference and three cells twice, with a warm-up before each three.
  EXPECT_EQ(run(text).measured, 7u);
  EXPECT_EQ(started().size(), std::string("grey\n").size() + 8 * std::string("brighter\n").size());
  const Results record = results();
  ASSERT_EQ(record.convergence.size(), 2u);
  EXPECT_EQ(record.convergence[0].engine, "brighter");
  EXPECT_EQ(record.convergence[1].engine, "brighter-control");
  const ConvergencePoint& point = record.convergence[0].points.at(0);
  EXPECT_EQ(point.seeds, 3);
  EXPECT_NEAR(point.relmse->value, 0.01 / 0.26, 1e-5);
  EXPECT_FALSE(point.bias2);
  EXPECT_FALSE(point.variance);
  EXPECT_EQ(point.undefined.at("bias2"), "one image for all seeds");
  EXPECT_EQ(record.caveats.back(), "control: 3 pairs of 'brighter' with itself are too few for an interval");
  EXPECT_FALSE(has("out/cells/warm-up"));
  // No cell is measured again, and the session's data are kept.
  const std::string before = get("out/results.json");
  EXPECT_EQ(run(text).measured, 0u);
  EXPECT_EQ(get("out/results.json"), before);
}

TEST_F(BenchRun, retry_measures_failures_again_and_only_those) {
  const std::string text = suite_text("grey", {"brighter", "fails", "refuses"});
  run(text);
  forget_log();
  options_.retry = true;
  EXPECT_EQ(run(text).measured, 1u);
  EXPECT_EQ(started(), "fails\n");
}

TEST_F(BenchRun, fresh_measures_all_again_and_destroys_nothing) {
  const std::string text = suite_text("grey", {"brighter"});
  run(text);
  const std::string old_record = get("out/results.json");
  const Result old_result = result_of("brighter");
  options_.fresh = true;
  EXPECT_EQ(run(text).measured, 2u);
  EXPECT_EQ(get("out/results-1.json"), old_record);
  EXPECT_TRUE(has("out/" + old_result.image));
  EXPECT_NE(result_of("brighter").image, old_result.image);
  EXPECT_EQ(result_of("brighter").key, old_result.key);
}

TEST_F(BenchRun, only_runs_what_matches_and_the_reference_it_needs) {
  options_.only = "brighter";
  const std::string text = suite_text("grey", {"brighter", "fails"});
  const BenchSummary summary = run(text);
  EXPECT_EQ(started(), "grey\nbrighter\n");
  EXPECT_EQ(summary.missing, 1u);
  EXPECT_EQ(results().results.size(), 2u);
}

TEST_F(BenchRun, changed_scene_version_or_limit_is_measured_again) {
  const std::string text = suite_text("grey", {});
  run(text);
  EXPECT_EQ(run(text).measured, 0u);
  put("scene.xml", std::string(scene_text) + "<!-- changed -->");
  EXPECT_EQ(run(text).measured, 1u);
  EXPECT_EQ(run(suite_text("grey", {}, "seconds = 21")).measured, 1u);
  suite_text("grey", {});  // writes the version file, so change it afterwards
  put("version", "fake 2\n");
  EXPECT_EQ(run(text).measured, 1u);
  put("version", "fake 1\n");
  EXPECT_EQ(run(text).measured, 0u);  // the old result still exists
}

TEST_F(BenchRun, changed_exposure_compares_again_without_measuring) {
  const std::string text = suite_text("grey", {"brighter"});
  run(text);
  const double before = metric(result_of("brighter"), "psnr");
  put("expect.toml", "purpose = 'to be measured'\nexposure = 0.0\n");
  EXPECT_EQ(run(text).measured, 0u);
  EXPECT_NE(metric(result_of("brighter"), "psnr"), before);
}

TEST_F(BenchRun, hdr_flip_is_computed_where_its_exposures_are_pinned_and_again_when_they_change) {
  const std::string text = suite_text("grey", {"brighter"});
  const auto hdr_flip = [this]() -> std::optional<MetricValue> {
    for (const MetricValue& value : result_of("brighter").metrics)
      if (value.name == "hdr_flip") return value;
    return std::nullopt;
  };
  run(text);
  EXPECT_FALSE(hdr_flip().has_value());
  EXPECT_FALSE(results().scenes[0].hdr_exposures.has_value());

  const std::string expect = get("expect.toml");
  put("expect.toml", expect + "hdr_flip_exposures = [-2, 1, 4]\n");
  EXPECT_EQ(run(text).measured, 0u);
  const std::optional<MetricValue> near = hdr_flip();
  ASSERT_TRUE(near.has_value());
  EXPECT_EQ(near->parameters, "tone_mapper=ACES, exposures=-2 1 4, pixels_per_degree=67.0206");
  EXPECT_EQ(results().scenes[0].hdr_exposures, (ExposureRange{-2, 1, 4}));

  // 30 stops down both images are black: no difference is left.
  put("expect.toml", expect + "hdr_flip_exposures = [-31, -30, 2]\n");
  EXPECT_EQ(run(text).measured, 0u);
  ASSERT_TRUE(hdr_flip().has_value());
  EXPECT_GT(near->value, 0.01);
  EXPECT_LT(hdr_flip()->value, 1e-4);

  put("expect.toml", expect);
  EXPECT_EQ(run(text).measured, 0u);
  EXPECT_FALSE(hdr_flip().has_value());
}

TEST_F(BenchRun, failed_reference_leaves_a_caveat_instead_of_metrics) {
  run(suite_text("fails", {"grey"}));
  const Result result = result_of("grey");
  EXPECT_EQ(result.status, Status::ok);
  EXPECT_TRUE(result.metrics.empty());
  EXPECT_NE(std::find(result.caveats.begin(), result.caveats.end(),
                      "not compared: the reference scene/fails/spp=1000/seed=0 ended as crash (exited with 5: out of "
                      "ideas)"),
            result.caveats.end());
}

TEST_F(BenchRun, scene_that_expects_an_engine_to_fail_is_not_tried_on_it) {
  put("expect.toml", "purpose = 'x'\nexposure = 0.0\n[unsupported]\nbrighter = 'too bright'\n");
  const BenchSummary summary = run(suite_text("grey", {"brighter"}));
  EXPECT_EQ(started(), "grey\n");
  EXPECT_EQ(summary.by_status.at(Status::unsupported), 1u);
  EXPECT_EQ(result_of("brighter").detail, "too bright");
}

TEST_F(BenchRun, engine_whose_version_command_is_not_there_is_not_started) {
  std::string text = suite_text("grey", {"brighter"});
  const std::string row = "name = 'brighter'";
  const auto at = text.find("[['cat', '{suite}/version']]", text.find(row));
  text.replace(at, 28, "[['no-such-program']]");
  run(text);
  EXPECT_EQ(result_of("brighter").status, Status::not_started);
  EXPECT_EQ(result_of("brighter").detail,
            "the engine prints no version: 'no-such-program' could not be started: 'no-such-program': No such file "
            "or directory; it is not on PATH");
}

TEST_F(BenchRun, an_engine_that_cannot_be_started_is_tried_again_when_it_is_there) {
  const std::string text = suite_text("grey", {}) +
                           "[[engine]]\nname = 'mine'\ntitle = 'm'\ncommand = ['bin/mine', '{suite}', '{output}', "
                           "'{scene}']\nbudgets = ['spp']\ntrust = 'external'\n"
                           "[[run]]\nengine = 'mine'\nbudgets = ['spp=1']\nseeds = [1]\n";
  EXPECT_EQ(run(text).by_status.at(Status::not_started), 1u);
  std::filesystem::create_directories(folder_ / "bin");
  put("bin/mine", "#!/bin/sh\ncp \"$1/brighter.exr\" \"$2\"\n");
  std::filesystem::permissions(folder_ / "bin/mine", std::filesystem::perms::owner_all);
  EXPECT_EQ(run(text).measured, 1u);
  EXPECT_EQ(result_of("mine").status, Status::ok);
}

TEST_F(BenchRun, engines_are_given_scenes_without_answers_and_results_name_the_scenes_themselves) {
  put("reference-32x24.exr", "an answer");
  put("ls.sh", "ls \"$(dirname \"$2\")\" > \"$1/$4\"; cp \"$1/grey.exr\" \"$3\"\n");
  std::string rows;
  for (const char* engine : {"judge", "judged"})
    rows += "[[engine]]\nname = '" + std::string(engine) + "'\ntitle = 'm'\ncommand = ['sh', '{suite}/ls.sh', " +
            "'{suite}', '{scene}', '{output}', 'seen-" + engine + "']\nbudgets = ['spp']\ntrust = 'external'\n";
  std::string text = suite_text("grey", {}) + rows + "[[run]]\nengine = 'judged'\nbudgets = ['spp=1']\nseeds = [1]\n";
  text.replace(text.find("engine = 'grey'"), 15, "engine = 'judge'");
  run(text);
  EXPECT_NE(get("seen-judge").find("reference-32x24.exr"), std::string::npos);  // the command prints the answer
  EXPECT_EQ(get("seen-judged").find("reference-"), std::string::npos);
  EXPECT_NE(get("seen-judged").find("scene.xml"), std::string::npos);
  EXPECT_NE(result_of("judged").command.find((folder_ / "scene.xml").string()), std::string::npos)
      << result_of("judged").command;
}

TEST_F(BenchRun, one_image_for_all_seeds_and_one_that_is_the_reference_are_named) {
  std::string text = suite_text("grey", {"brighter"});
  text.replace(text.rfind("seeds = [1]"), 11, "seeds = [1, 2, 3]");
  run(text);
  const std::string same =
      "scene/brighter/spp=1: all 3 seeds gave the same image; its noise is unknown, and need not be zero";
  EXPECT_EQ(results().findings, std::vector<std::string>{same});
  std::filesystem::copy_file(folder_ / "grey.exr", folder_ / "brighter.exr",
                             std::filesystem::copy_options::overwrite_existing);
  options_.fresh = true;
  run(text);
  ASSERT_EQ(results().findings.size(), 4u);
  EXPECT_EQ(results().findings[0], "scene/brighter/spp=1/seed=1: its image is the reference itself, bit for bit");
  EXPECT_EQ(results().findings[3], same);
}

TEST_F(BenchRun, image_that_two_of_three_seeds_gave_is_named) {
  put("two.sh", "if [ $3 = 3 ]; then cp \"$1/grey.exr\" \"$2\"; else cp \"$1/brighter.exr\" \"$2\"; fi\n");
  run(suite_text("grey", {}) +
      "[[engine]]\nname = 'two'\ntitle = 'm'\ncommand = ['sh', '{suite}/two.sh', '{suite}', '{output}', '{seed}', "
      "'{scene}']\nbudgets = ['spp']\ntrust = 'external'\n"
      "[[run]]\nengine = 'two'\nbudgets = ['spp=1']\nseeds = [1, 2, 3]\n");
  EXPECT_EQ(results().findings,
            (std::vector<std::string>{
                "scene/two/spp=1/seed=3: its image is the reference itself, bit for bit",
                "scene/two/spp=1: seeds 1, 2 gave the same image, which counts once; other seeds may not be "
                "independent either"}));
}

TEST_F(BenchRun, interrupt_keeps_what_is_finished_and_the_next_run_goes_on) {
  const std::string text = suite_text("grey", {"brighter", "sleeps"});
  // The suite's name determines the order of the two; the interrupt comes after the first of them.
  observer_.after_each = [this] { interrupt_ = observer_.seen.find("2/3") != std::string::npos; };
  const BenchSummary summary = run(text);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_EQ(summary.missing, 1u);
  EXPECT_EQ(results().results.size(), 2u);
  interrupt_ = false;
  observer_.after_each = {};
  forget_log();
  EXPECT_EQ(run(text).measured, 1u);
  EXPECT_EQ(started(), observer_.seen.find("2/3 brighter") != std::string::npos ? "sleeps\n" : "brighter\n");
  EXPECT_EQ(results().results.size(), 3u);
}

TEST_F(BenchRun, second_run_in_the_same_folder_is_refused) {
  observer_.after_each = [this] {
    Silent other;
    BenchOptions same = options_;
    EXPECT_TRUE(input_error_of([&] {
                  run_bench(read_suite(folder_ / "suite.toml"), same, other);
                }).starts_with(options_.results_folder.string() + ": error: another run is writing here"));
  };
  run(suite_text("grey", {}));
  EXPECT_EQ(observer_.seen, "1/1 grey\n");
}

TEST_F(BenchRun, broken_scene_is_an_input_error_before_anything_runs) {
  put("scene.xml", "<scene");
  EXPECT_NE(input_error_of([&] { run(suite_text("grey", {})); }), "no error");
  EXPECT_EQ(started(), "");
}

TEST_F(BenchRun, image_replaced_or_cut_short_is_measured_again) {
  const std::string text = suite_text("grey", {"brighter"});
  run(text);
  // The file has the size of the measured image.
  std::filesystem::copy_file(folder_ / "grey.exr", folder_ / "out" / result_of("brighter").image,
                             std::filesystem::copy_options::overwrite_existing);
  forget_log();
  EXPECT_EQ(run(text).measured, 1u);
  EXPECT_EQ(started(), "brighter\n");
  EXPECT_NEAR(metric(result_of("brighter"), "mse"), 0.01, 1e-6);
  std::filesystem::resize_file(folder_ / "out" / result_of("grey").image, 300);
  forget_log();
  EXPECT_EQ(run(text).measured, 1u);
  EXPECT_EQ(started(), "grey\n");
  EXPECT_NEAR(metric(result_of("brighter"), "mse"), 0.01, 1e-6);
}

TEST_F(BenchRun, reference_cut_short_while_others_run_leaves_them_without_metrics) {
  observer_.after_each = [this] {
    for (const auto& cell : std::filesystem::directory_iterator(folder_ / "out" / "cells"))
      if (std::filesystem::exists(cell.path() / "image.exr"))
        std::filesystem::resize_file(cell.path() / "image.exr", 300);
    observer_.after_each = {};
  };
  const std::string text = suite_text("grey", {"brighter"});
  const BenchSummary summary = run(text);
  EXPECT_EQ(summary.by_status.at(Status::bad_image), 1u);
  EXPECT_EQ(result_of("grey").detail, "its image could not be read any more when it was to be compared");
  EXPECT_TRUE(result_of("brighter").metrics.empty());
  EXPECT_EQ(run(text).measured, 1u);
  EXPECT_FALSE(result_of("brighter").metrics.empty());
}

TEST_F(BenchRun, engine_that_takes_the_cells_away_is_a_result) {
  std::string text = suite_text("grey", {"brighter"});
  text +=
      "[[engine]]\nname = 'vandal'\ntitle = 'fake'\ncommand = ['sh', '-c', 'rm -r $0; exit 5', '{suite}/out/cells', "
      "'{output}', '{scene}']\n"
      "budgets = ['spp']\ntrust = 'external'\nversions = [['cat', '{suite}/version']]\n"
      "[[run]]\nengine = 'vandal'\nbudgets = ['spp=1']\nseeds = [1]\n";
  const BenchSummary summary = run(text);
  EXPECT_EQ(summary.missing, 0u);
  EXPECT_EQ(result_of("vandal").status, Status::crash);
  EXPECT_TRUE(has("out/results.json"));
}

TEST_F(BenchRun, cells_folder_that_cannot_be_made_is_a_crash_of_each_cell) {
  put("suite.toml", "");
  std::filesystem::create_directories(folder_ / "out");
  put("out/cells", "a file");
  const BenchSummary summary = run(suite_text("grey", {"brighter"}));
  EXPECT_EQ(summary.by_status.at(Status::crash), 2u);
  EXPECT_TRUE(result_of("grey").detail.starts_with("its folder cannot be used: ")) << result_of("grey").detail;
}

// The messages distinguish a program that is missing, one that hangs and one that fails; each of them is a failure.
TEST_F(BenchRun, version_that_hangs_or_fails_is_no_pass) {
  const auto engine = [](const std::string& name, const std::string& version) {
    return "[[engine]]\nname = '" + name +
           "'\ntitle = 'fake'\ncommand = ['true', '{output}', '{scene}']\nversions = [" + version +
           "]\nbudgets = ['spp']\ntrust = 'external'\n[[run]]\nengine = '" + name +
           "'\nbudgets = ['spp=1']\nseeds = [1]\n";
  };
  const BenchSummary summary =
      run(suite_text("grey", {}, "seconds = 1") + engine("stuck", "['sleep', '30']") + engine("broken", "['false']") +
          engine("absent", "['no-such-program-anywhere']") + engine("optional", "['sh', '-c', 'exit 3']"));
  EXPECT_EQ(result_of("stuck").status, Status::timeout);
  EXPECT_EQ(result_of("stuck").detail, "the engine prints no version: 'sleep 30' killed after 1 s (limit)");
  EXPECT_EQ(result_of("broken").status, Status::crash);
  EXPECT_EQ(result_of("absent").status, Status::not_started);
  EXPECT_EQ(result_of("optional").status, Status::unsupported);
  EXPECT_EQ(result_of("optional").detail, "fake is not installed");
  EXPECT_EQ(summary.by_status.at(Status::timeout), 1u);
}

TEST_F(BenchRun, leftovers_of_a_killed_run_are_swept) {
  std::filesystem::create_directories(folder_ / "out" / "cells" / "warm-up");
  put("out/.results.partial-2000000000.json", "half");
  run(suite_text("grey", {}));
  EXPECT_FALSE(has("out/cells/warm-up"));
  EXPECT_FALSE(has("out/.results.partial-2000000000.json"));
}

class BenchOfStoredReference : public FakeGateTest {
 protected:
  Results run(const std::string& runs) {
    put("suite.toml", gates_text(runs));
    BenchOptions options;
    options.results_folder = folder_ / "out";
    options.program = "/bin/true";
    Silent observer;
    run_bench(read_suite(folder_ / "suite.toml"), options, observer);
    return read_results((folder_ / "out" / "results.json").string());
  }
  static constexpr const char* eight_seeds = "budgets = ['spp=64']\nseeds = [1, 2, 3, 4, 5, 6, 7, 8]\n";
};

// The prepared images are off by a normal 2 % a value; those of `dim` are halved in a corner.
TEST_F(BenchOfStoredReference, says_what_is_right_and_what_is_not) {
  put_reference();
  const Results results =
      run(std::string("[[run]]\nengine = 'good'\n") + eight_seeds + "[[run]]\nengine = 'dim'\n" + eight_seeds);
  EXPECT_EQ(results.scenes[0].reference_label, "");
  EXPECT_EQ(results.scenes[0].reference.value().provenance.at("estimator"), "path");
  ASSERT_EQ(results.results.size(), 16u) << "no reference was rendered";
  EXPECT_GT(results.results[0].metrics.size(), 0u);
  ASSERT_EQ(results.convergence.size(), 2u);
  const CorrectnessRecord& good = results.convergence[0].points[0].correctness.value();
  EXPECT_EQ(good.verdict, Correctness::right) << good.sentence;
  const CorrectnessRecord& dim = results.convergence[1].points[0].correctness.value();
  EXPECT_EQ(dim.verdict, Correctness::biased) << dim.sentence;
}

TEST_F(BenchOfStoredReference, that_is_missing_is_asked_for) {
  try {
    run(std::string("[[run]]\nengine = 'good'\n") + eight_seeds);
    FAIL() << "it ran";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("photonproof reference "), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace photonproof::inline harness_bench
