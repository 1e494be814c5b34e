// Disturbances of a run by others on the machine: a second run in its folder, and a changed clock.

#include <array>
#include <filesystem>

#include "harness/stress/faults/fault_rows.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

/// True if a run that shares its folder is refused in an orderly way.
bool is_refused(const ProcessEnd& end) {
  return end.exited && !end.hung && end.code == 2 && !end.standard_error.empty();
}

bool has_succeeded(const ProcessEnd& end, const Trial& trial) {
  return end.exited && !end.hung && end.code == trial.undisturbed.exit_code;
}

/// The library that replaces the clock, from Debian's package faketime.
fs::path faketime_library() {
  for (const char* folder : {"/usr/lib/x86_64-linux-gnu/faketime", "/usr/lib/aarch64-linux-gnu/faketime",
                             "/usr/lib64/faketime", "/usr/lib/faketime"}) {
    const fs::path file = fs::path(folder) / "libfaketimeMT.so.1";
    if (fs::exists(file)) return file;
  }
  throw NotTried{"libfaketime is not installed (Debian's package faketime)"};
}

}  // namespace

TrialResult two_runs_trial(const Trial& trial) {
  const fs::path beside = trial.folder / "second";
  fs::create_directories(beside);
  TrialResult result{1, {}};
  TestedProcess first(trial.work.command(trial.place), trial.folder);
  first.wait(trial.random(0) * trial.undisturbed.seconds);
  const ProcessEnd second_end = TestedProcess(trial.work.command(trial.place), beside).end(patience);
  const ProcessEnd first_end = first.end(patience);
  const bool succeeded = has_succeeded(first_end, trial) || has_succeeded(second_end, trial);
  for (const auto& [name, end] : {std::pair{"first", &first_end}, {"second", &second_end}})
    if (!has_succeeded(*end, trial) && !is_refused(*end))
      result.broken = std::string("the ") + name + " of two runs " + end->sentence();
  if (result.broken.empty() && !succeeded) result.broken = "both of two runs failed: " + first_end.sentence();
  FinishedParts finished;
  if (result.broken.empty()) result.broken = what_was_lost(trial, {}, finished);
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, finished);
  return result;
}

TrialResult clock_jumps_trial(const Trial& trial) {
  const fs::path library = faketime_library();
  const fs::path clock = trial.folder / "clock";
  write_file_atomically(clock, "+0\n");
  TestedProcess process(
      with_environment({"LD_PRELOAD=" + library.string(), "FAKETIME_TIMESTAMP_FILE=" + clock.string(),
                        "FAKETIME_NO_CACHE=1", "FAKETIME_DONT_FAKE_MONOTONIC=1", "DONT_FAKE_MONOTONIC=1"},
                       trial.work.command(trial.place)),
      trial.folder);
  std::uint64_t draw = 0;
  for (const char* jump : {"-365d\n", "+3650d\n", "-1d\n"}) {
    process.wait(trial.random(draw++) * trial.undisturbed.seconds / 3);
    write_file_atomically(clock, jump);
  }
  const ProcessEnd end = process.end(patience);
  TrialResult result{1, {}};
  if (!has_succeeded(end, trial)) result.broken = end.sentence();
  if (result.broken.empty() && trial.work.result(trial.place) != trial.undisturbed.result)
    result.broken = "came to something else";
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, {});
  return result;
}

}  // namespace photonproof::inline harness_stress_faults
