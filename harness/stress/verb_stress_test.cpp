// The program runs a few sweeps, resumes from kept levels, and distinguishes a faulty program from a sound one.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "harness/gates/gate_mutants.h"
#include "reports/stress/stress_record.h"
#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

class Stress : public ::testing::Test {
 protected:
  ProcessOutcome stress(const std::vector<std::string>& arguments) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY, "stress", "-o", folder_.path().string()};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    return run_process(argv, {.wall_limit_seconds = 120});
  }
  StressRecord record() const { return read_stress_record(folder_.path() / "stress.json"); }

  ScratchFolder folder_{"stress-test"};
};

TEST_F(Stress, sweep_runs_what_is_asked_for_and_keeps_it) {
  const ProcessOutcome first = stress({"--quick", "--only", "shape sphere, scale"});
  ASSERT_TRUE(first.ok()) << first.standard_output << first.standard_error;
  EXPECT_NE(first.standard_output.find("4 right, 0 silently wrong"), std::string::npos) << first.standard_output;
  EXPECT_TRUE(fs::exists(folder_.path() / "stress.html"));
  const StressRecord before = record();
  ASSERT_EQ(before.sweeps.size(), 4u);  // up and down, by path and photonmapper
  EXPECT_EQ(before.sweeps[0].right_up_to(), 15);
  const std::string kept = (folder_.path() / "old.json").string();
  fs::copy_file(folder_.path() / "stress.json", kept);
  const ProcessOutcome again = stress({"--quick", "--only", "shape sphere, scale", "--against", kept});
  EXPECT_TRUE(again.ok()) << again.standard_error;
  EXPECT_NE(again.standard_output.find("no regression against"), std::string::npos);
  EXPECT_EQ(record().sweeps[0].levels[0].seconds, before.sweeps[0].levels[0].seconds);  // was not rendered again
}

TEST_F(Stress, lets_other_programs_sweep_run_and_holds_compare_to_closed_forms) {
  const fs::path rows = folder_.path() / "engines.toml", table = folder_.path() / "table.md";
  write_file_atomically(rows,
                        "[[engine]]\nname = \"mine\"\ntitle = \"mine\"\ntrust = \"external\"\nbudgets = [\"spp\"]\n"
                        "command = [\"{photonproof}\", \"render\", \"{scene}\", \"-o\", \"{output}\", \"--size\", "
                        "\"{width}x{height}\", \"--seed\", \"{seed}\", \"--quiet\", \"{budget}\"]\n");
  const ProcessOutcome outcome =
      stress({"--quick", "--engines", rows.string(), "--engine", "mine", "--engine", "compare", "--only",
              "shape mesh, scale up", "--only", "metrics, images up", "--markdown", table.string()});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_output << outcome.standard_error;
  const StressRecord swept = record();
  ASSERT_EQ(swept.sweeps.size(), 2u);
  EXPECT_EQ(swept.sweeps[0].engine, "mine");
  EXPECT_EQ(swept.sweeps[0].right_up_to(), 15) << swept.sweeps[0].not_swept;
  EXPECT_EQ(swept.sweeps[1].engine, "compare");
  EXPECT_EQ(swept.sweeps[1].right_up_to(), 30);
  EXPECT_NE(read_file(table).find("| shape mesh | scale up | 15 | all (15) |"), std::string::npos) << read_file(table);
}

TEST_F(Stress, leaves_out_what_another_build_refuses) {
  const fs::path old = folder_.path() / "old";
  write_file_atomically(
      old,
      "#!/bin/sh\ngrep -q cylinder \"$2\" && echo 'scene.xml:1:1: error: no cylinders' >&2 && exit 2\n"
      "exec " PHOTONPROOF_BINARY " \"$@\"\n");
  fs::permissions(old, fs::perms::owner_all);
  const ProcessOutcome outcome = stress({"--quick", "--engine", "path", "--program", old.string(), "--only",
                                         "shape cylinder, scale up", "--only", "shape sphere, scale up"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_output << outcome.standard_error;
  EXPECT_NE(outcome.standard_output.find("1 right, 0 silently wrong; 1 of 2 sweeps left out"), std::string::npos)
      << outcome.standard_output;
  const StressRecord swept = record();
  ASSERT_EQ(swept.sweeps.size(), 2u);
  for (const StressSweep& sweep : swept.sweeps) {
    const bool is_known = sweep.feature == "shape sphere";
    EXPECT_EQ(sweep.levels.size(), is_known ? 1u : 0u);
    EXPECT_EQ(sweep.not_swept.find("no cylinders") == std::string::npos, is_known) << sweep.not_swept;
  }
}

TEST_F(Stress, fails_where_another_build_crashes) {
  const fs::path old = folder_.path() / "old";
  write_file_atomically(old, "#!/bin/sh\nkill -SEGV $$\n");
  fs::permissions(old, fs::perms::owner_all);
  const ProcessOutcome outcome =
      stress({"--quick", "--engine", "path", "--program", old.string(), "--only", "shape sphere, scale up"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.standard_output << outcome.standard_error;
  ASSERT_EQ(record().sweeps.size(), 1u);
  ASSERT_EQ(record().sweeps[0].levels.size(), 1u);
  EXPECT_EQ(record().sweeps[0].levels[0].outcome, LevelOutcome::crashed);
}

TEST_F(Stress, looks_again_where_noise_hides_what_a_level_is) {
  // With 64 samples of a light in a mirror the minimum detectable error is 14 %. The loss of the variance layer,
  // reported from 10^19 on, is no reason to stop there.
  const ProcessOutcome outcome = stress({"--quick", "--engine", "path", "--only", "bsdf conductor, radiance up"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  ASSERT_EQ(record().sweeps.size(), 1u);
  EXPECT_EQ(record().sweeps[0].right_up_to(), 30) << outcome.standard_output;
  EXPECT_LT(record().sweeps[0].levels[0].would_see.value_or(1), 0.1);

  // Light tracing's first look detects 13 %, and so would more looks beside an expected picture of 256 samples.
  ASSERT_TRUE(stress({"--quick", "--engine", "ptracer", "--only", "light constant, radiance up"}).ok());
  ASSERT_EQ(record().sweeps.size(), 1u);
  EXPECT_EQ(record().sweeps[0].right_up_to(), 30);
}

TEST_F(Stress, lights_of_every_size_light_a_floor_as_theory_says) {
  // Engines: paths that sample lights and hit them, lights only, and photons from lights. Each runs in a list of
  // primitives and in a hierarchy.
  const std::vector<std::vector<std::string>> sweep_runs{
      {"--engine", "path", "--engine", "whitted", "--only", "mesh, huge and tilted", "--only", "sphere, huge, over",
       "--only", "sphere, huge, around", "--only", "cylinder, huge, over a floor, in"},
      {"--engine", "ptracer", "--only", "sphere, huge, over a floor, in"},
      {"--engine", "volpath", "--only", "sphere, huge, over a floor, beside a medium"}};
  std::size_t sweeps = 0;
  for (const std::vector<std::string>& sweep_run : sweep_runs) {
    const ProcessOutcome outcome = stress(sweep_run);
    ASSERT_TRUE(outcome.ok()) << outcome.standard_output;
    for (const StressSweep& sweep : record().sweeps)
      EXPECT_GE(sweep.right_up_to().value_or(0), 9) << sweep.feature << ", " << sweep.sweep_run << ", " << sweep.engine;
    sweeps += record().sweeps.size();
  }
  EXPECT_EQ(sweeps, 16u);
}

TEST_F(Stress, light_that_grazes_turned_faces_is_right_or_said) {
  const ProcessOutcome outcome =
      stress({"--engine", "path", "--only", "near the floor, turned", "--only", "grazing, turned"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_output;
  ASSERT_EQ(record().sweeps.size(), 6u);
  for (const StressSweep& sweep : record().sweeps) {
    const std::string name = sweep.feature + ", " + sweep.sweep_run + ", " + sweep.engine;
    EXPECT_GE(sweep.right_up_to().value_or(0), sweep.wanted) << name;
    for (const StressLevel& level : sweep.levels)
      if (level.height >= 7 && level.height <= 9) {  // at 12 radiances exceed the limit of scenes
        // Rounding may hit the right side; the warning comes all the same.
        EXPECT_TRUE(level.outcome == LevelOutcome::degraded || level.outcome == LevelOutcome::right)
            << name << " " << level.height << ": " << to_string(level.outcome);
        EXPECT_NE(level.sentence.find("light that grazes it there is not known"), std::string::npos) << level.sentence;
      }
  }
}

TEST_F(Stress, turns_every_stage_where_asked_to) {
  const ProcessOutcome outcome = stress({"--turned", "--quick", "--engine", "path", "--only", "light rectangle, near",
                                         "--only", "shape mesh, translation"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_output;
  ASSERT_EQ(record().sweeps.size(), 2u);
  EXPECT_EQ(record().sweeps[0].sweep_run, "translation, turned");
  EXPECT_EQ(record().sweeps[0].right_up_to(), 9);
  EXPECT_EQ(record().sweeps[1].sweep_run, "near the floor, turned");
  EXPECT_EQ(record().sweeps[1].levels.back().outcome, LevelOutcome::degraded);  // without the turn it is right
}

TEST_F(Stress, refuses_what_it_does_not_know_in_one_line) {
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--engine", "nothing"}, {"--only", "nothing"}, {"--against", "nothing.json"}}) {
    const ProcessOutcome outcome = stress(wrong);
    EXPECT_EQ(outcome.exit_code, 2) << wrong[0];
    EXPECT_NE(outcome.standard_error.find("nothing"), std::string::npos) << outcome.standard_error;
  }
}

TEST_F(Stress, finds_a_fault_in_the_sweep_run_that_has_it_and_in_no_other) {
  // Without its cosine a beam of irradiance 1/sine lights the floor by 1/sine instead of by 1. Sizes and places of the
  // same scene do not show that. Faulty kernels exist for one instruction set only.
  const fs::path program = folder_.path() / "faulty.sh";
  std::string text = "#!/bin/sh\nexec " PHOTONPROOF_BINARY "-faulty \"$@\"";
  for (const std::string& argument : kernels_with_faults("path")) text += " " + argument;
  write_file_atomically(program, text + "\n");
  fs::permissions(program, fs::perms::owner_all);
  setenv("PHOTONPROOF_FAULT", "dropped-cosine", 1);
  const ProcessOutcome outcome =
      stress({"--quick", "--engine", "path", "--only", "light directional", "--program", program.string()});
  unsetenv("PHOTONPROOF_FAULT");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.standard_error;
  ASSERT_EQ(record().sweeps.size(), 7u);
  for (const StressSweep& sweep : record().sweeps) {
    const bool is_grazing = sweep.sweep_run.starts_with("grazing");  // straight and turned
    EXPECT_EQ(sweep.breakdown() != nullptr, is_grazing) << sweep.sweep_run << ": " << outcome.standard_output;
    if (is_grazing && sweep.breakdown() != nullptr) {
      EXPECT_EQ(sweep.breakdown()->height, 1);
    }
  }
}

}  // namespace
}  // namespace photonproof::inline harness_stress
