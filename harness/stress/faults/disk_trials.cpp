// Disks that are full, read-only or gone. mount(8) makes the file systems in the run's own mount namespace, so that
// nothing of them remains. An ordinary user gets a user namespace as well.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "harness/stress/faults/fault_rows.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t page = 4096;

/// `sh -c script` with its words after it, in a namespace where it may mount.
std::vector<std::string> where_mounting(const std::string& script, const std::vector<std::string>& words) {
  std::vector<std::string> argv{"unshare"};
  if (geteuid() != 0) argv.insert(argv.end(), {"--user", "--map-root-user"});
  argv.insert(argv.end(), {"--mount", "sh", "-c", script, "sh"});
  argv.insert(argv.end(), words.begin(), words.end());
  return argv;
}

void need_mounts() {
  static const ProcessOutcome tried =
      run_process(where_mounting("mount -t tmpfs -o size=4k none /tmp", {}), {.wall_limit_seconds = 20});
  if (tried.ok()) return;
  const std::string message = last_line(tried.standard_error);
  throw NotTried{"no file system can be mounted here: " + (message.empty() ? tried.sentence() : message)};
}

std::vector<std::string> then(std::vector<std::string> words, const std::vector<std::string>& command) {
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

/// Kills a run at half its time, so that there is something to resume.
void do_half(const Trial& trial) {
  TestedProcess process(trial.work.command(trial.place), trial.folder);
  process.wait((0.25 + 0.5 * trial.random(100)) * trial.undisturbed.seconds);
}

}  // namespace

TrialResult full_disk_trial(const Trial& trial) {
  need_mounts();
  const fs::path kept = trial.folder / "kept";
  fs::remove_all(kept);
  fs::create_directories(kept);
  // The size ranges from nothing to nearly enough; a file system has whole pages.
  const auto size =
      std::max(page, static_cast<std::uintmax_t>(trial.random(0) * static_cast<double>(trial.undisturbed.bytes)));
  const std::string script =
      "mount -t tmpfs -o size=\"$1\" none \"$2\" || exit 99\nfrom=$2 to=$3\nshift 3\n\"$@\"\ncode=$?\n"
      "cp -a \"$from/.\" \"$to/\" || exit 98\nexit $code";
  const ProcessEnd end =
      TestedProcess(where_mounting(script, then({std::to_string(size), trial.place.out.string(), kept.string()},
                                                trial.work.command(trial.place))),
                    trial.folder)
          .end(patience);
  TrialResult result{1, what_is_disorderly(end)};
  if (!result.broken.empty()) result.broken = "on a disk of " + std::to_string(size) + " bytes it " + result.broken;
  fs::remove_all(trial.place.out);
  fs::rename(kept, trial.place.out);
  FinishedParts finished;
  if (result.broken.empty()) result.broken = what_was_lost(trial, {}, finished);
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, finished);
  return result;
}

TrialResult read_only_disk_trial(const Trial& trial) {
  need_mounts();
  if (trial.random(1) < 0.7) do_half(trial);  // else nothing is done yet
  FinishedParts before, after;
  TrialResult result{1, what_was_lost(trial, {}, before)};
  if (!result.broken.empty()) return result;
  const std::string script =
      "mount --bind \"$1\" \"$1\" && mount -o remount,ro,bind \"$1\" || exit 99\nshift\nexec \"$@\"";
  const ProcessEnd end =
      TestedProcess(where_mounting(script, then({trial.place.out.string()}, trial.work.command(trial.place))),
                    trial.folder)
          .end(patience);
  result.broken = what_is_disorderly(end);
  if (result.broken.empty() && end.code == 0) result.broken = "succeeded, though it could not write anything";
  if (result.broken.empty()) result.broken = what_was_lost(trial, before, after);
  if (result.broken.empty() && after != before)
    result.broken = "finished something, though it could not write anything";
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, before);
  return result;
}

TrialResult vanishing_disk_trial(const Trial& trial) {
  const fs::path gone = trial.place.out.string() + "-gone";
  fs::remove_all(gone);
  TestedProcess process(trial.work.command(trial.place), trial.folder);
  std::optional<ProcessEnd> end = process.wait(trial.random(2) * trial.undisturbed.seconds);
  TrialResult result;
  if (!end) {
    fs::rename(trial.place.out, gone);
    end = process.end(patience);
    result.count = 1;
    fs::remove_all(trial.place.out);  // removes what the run made anew under its name
    fs::rename(gone, trial.place.out);
  }
  result.broken = what_is_disorderly(*end);
  FinishedParts finished;
  if (result.broken.empty()) result.broken = what_was_lost(trial, {}, finished);
  if (result.broken.empty()) result.broken = what_differs_when_finished(trial, finished);
  return result;
}

}  // namespace photonproof::inline harness_stress_faults
