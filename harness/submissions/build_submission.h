// Builds a submission that was taken in, in the sandbox: the compiler and the makefile are as little trusted as the
// program, and see nothing but the submission and staff's files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/sandbox/sandbox.h"
#include "harness/submissions/submission.h"

namespace photonproof::inline harness_submissions {

/// Where a submission's tree is seen, at the build as at a run: paths that are compiled in stay right.
inline constexpr const char* submission_inside = "/submission";

struct BuildRecipe {
  std::vector<std::string> command{};  ///< empty: nothing to build
  std::filesystem::path overwrite{};   ///< a folder whose tree is copied over the submission's before; empty: none
  std::map<std::string, std::string> environment{};
  SandboxLimits limits{};
};

struct BuildOutcome {
  bool ok = false;
  bool timed_out = false;
  std::string sentence;  ///< "built in 3.2 s", "the build exited with 2: a.cpp:7:5: error: ..."
  std::string log_tail;  ///< the last 16 KiB that it wrote, errors behind output
  double seconds = 0, cpu_seconds = 0;
};

/// Builds a copy of `submission`, which is not changed, and leaves the tree in `built`, which is made and must not
/// exist. Throws InputError for the grader's own troubles.
BuildOutcome build_submission(const std::filesystem::path& submission, const BuildRecipe& recipe,
                              const std::filesystem::path& built, const Handling& handling = {});

/// Each {name} in a word of the command by its value. Throws InputError for a name that has none.
std::vector<std::string> with_values(const std::vector<std::string>& command,
                                     const std::map<std::string, std::string>& values);

/// The outcome as a sentence about `subject`: "the program was killed by SIGSEGV".
std::string said_of(const std::string& subject, const SandboxOutcome& outcome);

/// The end of a log that is worth keeping.
std::string log_tail(const ProcessOutcome& process);

}  // namespace photonproof::inline harness_submissions
