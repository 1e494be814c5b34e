// Every fault of numbers breaks exactly its own ones of the sweeps that tell the faults apart.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "harness/gates/gate_mutants.h"
#include "reports/stress/stress_record.h"
#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

/// The sweeps that tell faults apart: feature and sweep, by path unless a line names another engine.
const std::vector<std::string> telling_runs{
    "shape sphere, scale up",        "shape sphere, scale down",          "shape sphere, translation",
    "shape sphere, as a huge floor", "shape cylinder, as a huge floor",   "coincident faces, glass in glass",
    "light cylinder, tiny",          "light directional, grazing",        "texture bitmap, moved uv",
    "bsdf conductor, high ior",      "light directional, grazing, turned"};

struct FaultAndSweepRuns {
  std::string name, engine;
  std::set<std::string> breaks;
};

void PrintTo(const FaultAndSweepRuns& fault, std::ostream* out) { *out << fault.name; }

class NumericFaults : public ::testing::TestWithParam<FaultAndSweepRuns> {
 protected:
  /// The program with this fault, as a command of its own, so that no kept result of another counts.
  fs::path program_with(const FaultAndSweepRuns& fault) const {
    const fs::path file = folder_.path() / "faulty.sh";
    std::string text =
        "#!/bin/sh\nexport PHOTONPROOF_FAULT=" + fault.name + "\nexec " PHOTONPROOF_BINARY "-faulty \"$@\"";
    for (const std::string& argument : kernels_with_faults(fault.engine)) text += " " + argument;
    write_file_atomically(file, text + "\n");
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }

  ScratchFolder folder_{"numeric-faults"};
};

TEST_P(NumericFaults, break_their_own_sweep_runs_and_no_other) {
  const FaultAndSweepRuns& fault = GetParam();
  std::vector<std::string> command{PHOTONPROOF_BINARY, "stress",     "-o",        (folder_.path() / "out").string(),
                                   "--engine",         fault.engine, "--program", program_with(fault).string()};
  for (const std::string& sweep_run : telling_runs) command.insert(command.end(), {"--only", sweep_run});
  const ProcessOutcome outcome = run_process(command, {.wall_limit_seconds = 120});
  ASSERT_LE(outcome.exit_code, 1) << outcome.standard_output << outcome.standard_error;
  std::set<std::string> broken;
  const StressRecord record = read_stress_record(folder_.path() / "out/stress.json");
  EXPECT_EQ(record.sweeps.size(), telling_runs.size());
  for (const StressSweep& sweep : record.sweeps)
    if (!sweep.reaches_wanted()) broken.insert(sweep.feature + ", " + sweep.sweep_run);
  EXPECT_EQ(broken, fault.breaks) << outcome.standard_output;
}

INSTANTIATE_TEST_SUITE_P(
    all, NumericFaults,
    ::testing::Values(
        FaultAndSweepRuns{
            "dropped-cosine", "path", {"light directional, grazing", "light directional, grazing, turned"}},
        FaultAndSweepRuns{"no-recentring", "path", {"shape sphere, translation"}},
        FaultAndSweepRuns{"no-rescaling", "path", {"shape sphere, scale up"}},
        FaultAndSweepRuns{"float-faces", "path", {"shape sphere, as a huge floor"}},
        FaultAndSweepRuns{"float-sphere", "path", {"shape sphere, as a huge floor"}},
        FaultAndSweepRuns{"float-cylinder", "path", {"shape cylinder, as a huge floor"}},
        FaultAndSweepRuns{"lost-height", "path", {"light cylinder, tiny"}},
        FaultAndSweepRuns{"far-periods", "path", {"texture bitmap, moved uv"}},
        FaultAndSweepRuns{"fixed-step", "path", {"shape sphere, scale down", "coincident faces, glass in glass"}},
        FaultAndSweepRuns{"unclamped-metal", "path", {"bsdf conductor, high ior"}}),
    [](const auto& of) {
      std::string name = of.param.name;
      for (char& letter : name)
        if (letter == '-') letter = '_';
      return name;
    });

}  // namespace
}  // namespace photonproof::inline harness_stress
