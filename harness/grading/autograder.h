// The zip file from which Gradescope makes an autograder: this program, an assignment's folder, setup.sh,
// run_autograder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"

namespace photonproof::inline harness_grading {

struct AutograderOptions {
  std::filesystem::path program;  ///< This program; its module of image formats is in ../lib.
  bool contained = true;          ///< False: run_autograder passes --no-sandbox, for hosts without user namespaces.
};

/// Writes the archive and returns the names of its members. Of the assignment's folder it has the files that the
/// assignment and its scenes name, and nothing else, such as other submissions. Its setup.sh installs the packages of
/// the program's libraries, as found on this machine. So it is for images of the same distribution and release. Throws
/// InputError where a file cannot be read, or the assignment names files outside its folder, which would be missing
/// there.
std::vector<std::string> write_autograder(const Assignment& assignment, const AutograderOptions& options,
                                          const std::filesystem::path& archive);

}  // namespace photonproof::inline harness_grading
