// Builds a submission in the sandbox. The compiler and the makefile are trusted as little as the program, and see
// nothing but the submission and the staff's files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/sandbox/sandbox.h"
#include "harness/submissions/submission.h"

namespace photonproof::inline harness_submissions {

/// Path of a submission's tree inside, the same for build and run, so that compiled-in paths stay right.
inline constexpr const char* submission_inside = "/submission";

struct BuildRecipe {
  std::vector<std::string> command{};  ///< empty: nothing to build
  std::filesystem::path overwrite{};   ///< a folder whose tree first replaces the submission's files; empty: none
  std::map<std::string, std::string> environment{};
  SandboxLimits limits{};
};

struct BuildOutcome {
  bool ok = false;
  bool timed_out = false;
  std::string sentence;  ///< "built in 3.2 s", "the build exited with 2: a.cpp:7:5: error: ..."
  std::string log_tail;  ///< last 16 KiB that it wrote, errors after output
  double seconds = 0, cpu_seconds = 0;
};

/// Builds a copy of `submission`, which stays unchanged, and leaves the tree in `built`, a new folder. Throws
/// InputError for failures of the grader itself.
BuildOutcome build_submission(const std::filesystem::path& submission, const BuildRecipe& recipe,
                              const std::filesystem::path& built, const Handling& handling = {});

/// Replaces each {name} in the command by its value. Throws InputError for a name without a value.
std::vector<std::string> with_values(const std::vector<std::string>& command,
                                     const std::map<std::string, std::string>& values);

/// The outcome as a sentence about `subject`: "the program was killed by SIGSEGV".
std::string outcome_sentence(const std::string& subject, const SandboxOutcome& outcome);

/// The end of a log, short enough to keep.
std::string log_tail(const ProcessOutcome& process);

}  // namespace photonproof::inline harness_submissions
