// The zip that Gradescope makes an autograder of: this program, an assignment's folder, setup.sh and run_autograder.
#pragma once

#include <filesystem>

#include "harness/grading/assignment.h"

namespace photonproof::inline harness_grading {

struct AutograderOptions {
  std::filesystem::path program;  ///< this one; its module of image formats lies in ../lib
  bool contained = true;          ///< false: run_autograder passes --no-sandbox, for hosts without user namespaces
};

/// Writes the archive. setup.sh installs the packages that the program's libraries come from, as found out here, so it
/// is for images of the same distribution and release. Throws InputError where a file cannot be read, or the assignment
/// names files outside its folder, which would be missing there.
void write_autograder(const Assignment& assignment, const AutograderOptions& options,
                      const std::filesystem::path& archive);

}  // namespace photonproof::inline harness_grading
