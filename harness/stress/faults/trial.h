// One trial of a fault on one work: a fresh folder, the fault, then the work is finished in peace and compared with
// what it comes to when nothing befalls it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/stress/faults/victim.h"
#include "harness/stress/faults/work.h"

namespace photonproof::inline harness_stress_faults {

/// What a work does in peace.
struct Undisturbed {
  int exit_code = 0;
  double seconds = 0;        ///< wall time, of the run that was measured first
  std::uintmax_t bytes = 0;  ///< that its folder then held
  std::string result;
};

/// What a trial may use.
struct Trial {
  const Work& work;
  WorkPlace place;               ///< `out` is made anew before a trial
  std::filesystem::path folder;  ///< of the trial, for what it needs beside
  Undisturbed undisturbed;
  std::uint64_t seed = 1;  ///< decides moments and sizes

  /// In [0, 1), another one for another `draw`.
  double random(std::uint64_t draw) const;
};

struct TrialResult {
  int count = 0;       ///< faults that befell: kills, or 1
  std::string broken;  ///< what did not hold, a sentence; empty where all did
};

/// Thrown where this machine cannot make the fault: no mount namespaces, no faketime.
struct NotTried {
  std::string why;
};

/// A work in peace may take so long, in seconds; what was hurt has to end by itself within that time, too. Long enough
/// for a machine whose cores others want as well.
inline constexpr double patience = 300;

/// An empty `out`.
void begin_anew(const WorkPlace& place);

/// Runs the work to its end twice, to know that it comes to the same. Throws InputError where it does not.
Undisturbed undisturbed(const Work& work, const WorkPlace& place, const std::filesystem::path& folder);

/// After a fault: what is finished can be read, nothing of `before` is gone or another. Empty, or what is not so;
/// `now` receives what is finished.
std::string what_was_lost(const Trial& trial, const FinishedParts& before, FinishedParts& now);

/// Finishes the work in peace: it ends as it should, with the same result, and no part was finished twice.
std::string what_differs_when_finished(const Trial& trial, const FinishedParts& before);

/// Of a run that was hurt: empty where it is orderly and, unless it succeeded, says in words what was the matter.
std::string what_is_disorderly(const VictimEnd& end);

}  // namespace photonproof::inline harness_stress_faults
