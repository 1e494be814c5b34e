#include <filesystem>

#include "harness/stress/faults/bad_disk.h"
#include "harness/stress/faults/fault_rows.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

constexpr const char* delay = "0.002";  // seconds a call

/// Uses the hidden subcommand of faults_trial.cpp.
std::vector<std::string> on_bad_disk(const std::vector<std::string>& options, const std::vector<std::string>& command) {
  std::vector<std::string> words{fs::read_symlink("/proc/self/exe").string(), "on-bad-disk"};
  words.insert(words.end(), options.begin(), options.end());
  words.emplace_back("--");
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

void check_that_it_was_tried(const ProcessEnd& end) {
  if (end.exited && end.code == no_bad_disk_exit_code)
    throw NotTried{"this system does not let us be asked about system calls (seccomp_unotify)"};
}

}  // namespace

TrialResult slow_disk_trial(const Trial& trial) {
  const ProcessEnd end =
      TestedProcess(on_bad_disk({"--delay", delay}, trial.work.command(trial.place)), trial.folder).end(patience);
  check_that_it_was_tried(end);
  TrialResult result{1, {}};
  if (!end.exited || end.hung || end.code != trial.undisturbed.exit_code) result.broken = end.sentence();
  if (result.broken.empty() && trial.work.result(trial.place) != trial.undisturbed.result)
    result.broken = "came to something else";
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, {});
  return result;
}

TrialResult failing_disk_trial(const Trial& trial) {
  const std::string after = std::to_string(trial.random(0) * trial.undisturbed.seconds);
  const ProcessEnd end = TestedProcess(on_bad_disk({"--fails-after", after, "--folder", trial.place.out.string()},
                                                   trial.work.command(trial.place)),
                                       trial.folder)
                             .end(patience);
  check_that_it_was_tried(end);
  TrialResult result{1, what_is_disorderly(end)};
  FinishedParts finished;
  if (result.broken.empty()) result.broken = what_was_lost(trial, {}, finished);
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, finished);
  return result;
}

}  // namespace photonproof::inline harness_stress_faults
