// The works that faults disturb: small runs of bench, gate, reference, render and grade. No fault may undo a work's
// finished parts or change its result.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

/// The files and folders of a work.
struct WorkPlace {
  std::filesystem::path program;  ///< The program photonproof.
  std::filesystem::path inputs;   ///< Scenes, suites and submissions, as prepare_works writes them.
  std::filesystem::path out;      ///< Receives all that the work writes; exists.
};

/// Finished parts: the name contains all inputs of a part, the value is the checksum of its result.
using FinishedParts = std::map<std::string, std::string>;

struct Work {
  std::string name;  ///< "bench".
  /// Starts the work, or resumes it.
  std::function<std::vector<std::string>(const WorkPlace&)> command;
  /// The parts that are finished: folders of cells, batches. Throws InputError where a record is damaged.
  std::function<FinishedParts(const WorkPlace&)> finished;
  /// The result of the finished work, a line a number, without times. Throws InputError where something is missing.
  std::function<std::string(const WorkPlace&)> result;
};

/// bench, gate, reference, grade, and render by three integrators.
const std::vector<Work>& works();

/// Writes the works' inputs to `inputs`. Throws InputError where the program cannot render their reference.
void prepare_works(const std::filesystem::path& program, const std::filesystem::path& inputs);

/// Names of parts that were finished more than once.
std::vector<std::string> finished_twice(const FinishedParts& parts);

/// The command with variables of the environment before it: `env NAME=VALUE ...`.
std::vector<std::string> with_environment(const std::vector<std::string>& variables,
                                          const std::vector<std::string>& command);

}  // namespace photonproof::inline harness_stress_faults
