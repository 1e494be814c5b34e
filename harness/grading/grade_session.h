// Grades a class: builds, references, images, verdicts, speed, points. The folder keeps finished parts, and an
// interrupted grading resumes from them.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "reports/grades/grade_record.h"

namespace photonproof::inline harness_grading {

struct GradeOptions {
  std::filesystem::path folder;   ///< Receives everything.
  std::filesystem::path program;  ///< This program.
  std::vector<std::filesystem::path> submissions;
  std::string command;                          ///< Repeats the grading.
  std::map<std::string, std::string> versions;  ///< For the record.
  std::string only, scene;  ///< Submissions whose name contains `only`, and the one scene to grade. Empty: all.
  std::uint64_t seed = 1;
  int threads = 0;        ///< The number of threads given to programs, 0: all cores.
  bool resume = false;    ///< Use the results of an interrupted grading.
  bool fresh = false;     ///< Make references anew, too.
  bool contained = true;  ///< False: --no-sandbox.
  bool timing = true;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const std::string&)> progress;   ///< One line about the current step.
  std::function<void(const SubmissionGrade&)> heard;  ///< Called for each submission whose images are judged.
};

/// Throws InputError before any run for an assignment, submission file or folder that cannot be used, and where the
/// baseline cannot be built or run. Failures of a submission are part of its grade.
Grades grade_submissions(const Assignment& assignment, const GradeOptions& options);

}  // namespace photonproof::inline harness_grading
