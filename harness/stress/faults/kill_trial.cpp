#include <array>
#include <chrono>
#include <csignal>
#include <thread>

#include "harness/stress/faults/fault_rows.h"
#include "scenes/base/timer.h"

namespace photonproof::inline harness_stress_faults {
namespace {

constexpr int most_kills = 4;
constexpr std::array signals{SIGKILL, SIGTERM, SIGINT};

/// True if engines outlive the run that started them; a busy machine takes some time to end them.
bool leaves_processes(const Trial& trial) {
  const Timer timer;
  while (runs_with(trial.place.out.string())) {
    if (timer.seconds() > 10) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

/// SIGTERM and SIGINT may come before the program handles them, be obeyed, or come too late; SIGKILL always ends it.
bool ended_as_signalled(const ProcessEnd& end, int signal_number, int undisturbed_code) {
  if (end.hung) return false;
  if (!end.exited) return end.signal == signal_number;
  return end.code == 130 || end.code == undisturbed_code;
}

}  // namespace

TrialResult kill_trial(const Trial& trial) {
  TrialResult result;
  FinishedParts finished;
  for (std::uint64_t attempt = 0; attempt < most_kills; ++attempt) {
    TestedProcess process(trial.work.command(trial.place), trial.folder);
    if (process.wait(trial.random(3 * attempt) * trial.undisturbed.seconds)) break;  // finished before the signal
    const int signal_number = signals[static_cast<std::size_t>(trial.random(3 * attempt + 1) * signals.size())];
    process.send(signal_number);
    const ProcessEnd end = process.end(patience);
    ++result.count;
    if (!ended_as_signalled(end, signal_number, trial.undisturbed.exit_code))
      result.broken = "told to end by signal " + std::to_string(signal_number) + " it " + end.sentence();
    if (result.broken.empty() && leaves_processes(trial)) result.broken = "killed, it leaves processes behind";
    FinishedParts now;
    if (result.broken.empty()) result.broken = what_was_lost(trial, finished, now);
    if (!result.broken.empty()) return result;
    finished = std::move(now);
  }
  result.broken = what_differs_when_finished(trial, finished);
  return result;
}

}  // namespace photonproof::inline harness_stress_faults
