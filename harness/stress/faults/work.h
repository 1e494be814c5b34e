// The works that faults befall: small runs of bench, gate, reference, render and grade, each with what it has done so
// far, which no fault may take back, and what it comes to, which no fault may change.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

/// Where a work is done.
struct WorkPlace {
  std::filesystem::path program;  ///< photonproof
  std::filesystem::path inputs;   ///< scenes, suites and submissions, as prepare_works leaves them
  std::filesystem::path out;      ///< all that the work writes; exists
};

/// Finished parts, by a name that says all they follow from, and the checksum of what they came to.
using FinishedParts = std::map<std::string, std::string>;

struct Work {
  std::string name;  ///< "bench"
  /// Begins, or goes on from what there is.
  std::function<std::vector<std::string>(const WorkPlace&)> command;
  /// The parts that are finished: folders of cells, batches. Throws InputError where a record is damaged.
  std::function<FinishedParts(const WorkPlace&)> finished;
  /// What the finished work comes to, a line a number, without times. Throws InputError where something is missing.
  std::function<std::string(const WorkPlace&)> result;
};

/// bench, gate, reference, grade, and render by three integrators.
const std::vector<Work>& works();

/// Writes what the works need to `inputs`. Throws InputError where the program cannot render their reference.
void prepare_works(const std::filesystem::path& program, const std::filesystem::path& inputs);

/// Names of parts that were finished more than once.
std::vector<std::string> finished_twice(const FinishedParts& parts);

/// The command with variables of the environment before it: `env NAME=VALUE ...`.
std::vector<std::string> with_environment(const std::vector<std::string>& variables,
                                          const std::vector<std::string>& command);

}  // namespace photonproof::inline harness_stress_faults
