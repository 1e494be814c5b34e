#include "harness/stress/faults/trial.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "scenes/base/input_error.h"
#include "scenes/base/splitmix.h"
#include "scenes/base/timer.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

/// The first line in which two texts differ.
std::string first_difference(const std::string& expected, const std::string& found) {
  std::istringstream a(expected), b(found);
  std::string left, right;
  while (true) {
    const bool more_left = static_cast<bool>(std::getline(a, left)),
               more_right = static_cast<bool>(std::getline(b, right));
    if (!more_left) left = "(nothing)";
    if (!more_right) right = "(nothing)";
    if (left != right || !more_left || !more_right) return "'" + right + "' instead of '" + left + "'";
  }
}

}  // namespace

double Trial::random(std::uint64_t draw) const { return static_cast<double>(splitmix64(seed, draw) >> 11) * 0x1p-53; }

void begin_anew(const WorkPlace& place) {
  fs::remove_all(place.out);
  fs::create_directories(place.out);
}

Undisturbed undisturbed(const Work& work, const WorkPlace& place, const fs::path& folder) {
  Undisturbed first;
  for (int run = 0; run < 2; ++run) {
    begin_anew(place);
    const Timer timer;
    const ProcessEnd end = TestedProcess(work.command(place), folder).end(patience);
    const double seconds = timer.seconds();
    if (!end.is_orderly() || end.code == 2) throw InputError(work.name, "in peace " + end.sentence());
    const std::string result = work.result(place);
    if (run == 0) first = {end.code, seconds, bytes_in(place.out), result};
    if (result != first.result || end.code != first.exit_code)
      throw InputError(work.name,
                       "comes to something else the second time, in peace: " + first_difference(first.result, result));
  }
  return first;
}

std::string what_was_lost(const Trial& trial, const FinishedParts& before, FinishedParts& now) {
  try {
    now = trial.work.finished(trial.place);
  } catch (const InputError& error) {
    return "left what cannot be read: " + error.summary();
  }
  for (const auto& [name, checksum] : before) {
    const auto found = now.find(name);
    if (found == now.end()) return name + " was finished and is gone";
    if (found->second != checksum) return name + " was finished and is another";
  }
  return {};
}

std::string what_differs_when_finished(const Trial& trial, const FinishedParts& before) {
  const ProcessEnd end = TestedProcess(trial.work.command(trial.place), trial.folder).end(patience);
  if (!end.exited || end.hung || end.code != trial.undisturbed.exit_code)
    return fmt::format("finished in peace it {}, where it should exit with {}", end.sentence(),
                       trial.undisturbed.exit_code);
  FinishedParts parts;
  if (std::string lost = what_was_lost(trial, before, parts); !lost.empty()) return "finished in peace: " + lost;
  if (const auto twice = finished_twice(parts); !twice.empty())
    return fmt::format("measured twice: {}", fmt::join(twice, ", "));
  try {
    const std::string result = trial.work.result(trial.place);
    if (result == trial.undisturbed.result) return {};
    return "finished in peace it came to " + first_difference(trial.undisturbed.result, result);
  } catch (const InputError& error) {
    return "finished in peace: " + error.summary();
  }
}

std::string what_is_disorderly(const ProcessEnd& end) {
  if (!end.is_orderly()) return end.sentence();
  if (end.code != 2) return {};
  if (end.standard_error.find_first_not_of(" \n") == std::string::npos) return "exited with 2 without a word";
  return {};
}

}  // namespace photonproof::inline harness_stress_faults
