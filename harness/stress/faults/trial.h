// One trial of a fault on one work. In a fresh folder the fault occurs; then the work finishes undisturbed, and its
// result is compared with that of a run without the fault.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/stress/faults/tested_process.h"
#include "harness/stress/faults/work.h"

namespace photonproof::inline harness_stress_faults {

/// The undisturbed run of a work.
struct Undisturbed {
  int exit_code = 0;
  double seconds = 0;        ///< Wall time of the run that was measured first.
  std::uintmax_t bytes = 0;  ///< Bytes in its folder after that.
  std::string result;
};

/// The inputs of a trial.
struct Trial {
  const Work& work;
  WorkPlace place;               ///< `out` is made anew before a trial.
  std::filesystem::path folder;  ///< The trial's own folder for other files.
  Undisturbed undisturbed;
  std::uint64_t seed = 1;  ///< Decides moments and sizes.

  /// In [0, 1), a different number for each `draw`.
  double random(std::uint64_t draw) const;
};

struct TrialResult {
  int count = 0;       ///< Faults that occurred: kills, or 1.
  std::string broken;  ///< The property that did not hold, as a sentence; empty if all held.
};

/// Thrown where this machine cannot cause the fault: no mount namespaces, no faketime.
struct NotTried {
  std::string why;
};

/// The limit in seconds for an undisturbed work, and for a disturbed one to end by itself. It suffices for a machine
/// whose cores have other work, too.
inline constexpr double patience = 300;

/// An empty `out`.
void begin_anew(const WorkPlace& place);

/// Runs the work to its end twice and compares the results. Throws InputError where they differ.
Undisturbed undisturbed(const Work& work, const WorkPlace& place, const std::filesystem::path& folder);

/// Checks after a fault that finished parts can be read and that no part of `before` is missing or changed. Returns the
/// violation, or an empty text; `now` receives the finished parts.
std::string what_was_lost(const Trial& trial, const FinishedParts& before, FinishedParts& now);

/// Finishes the work undisturbed. It must end normally, with the same result, and no part may be finished twice.
std::string what_differs_when_finished(const Trial& trial, const FinishedParts& before);

/// Empty if a disturbed run ended orderly and, unless it succeeded, printed a reason; else the violation.
std::string what_is_disorderly(const ProcessEnd& end);

}  // namespace photonproof::inline harness_stress_faults
