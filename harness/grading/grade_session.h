// Grades a class: builds, references, images, verdicts, speed, points. What is finished is kept in the folder, and an
// interrupted grading goes on from it.
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
  std::filesystem::path folder;   ///< receives everything
  std::filesystem::path program;  ///< this one
  std::vector<std::filesystem::path> submissions;
  std::string command;                          ///< how the grading is repeated
  std::map<std::string, std::string> versions;  ///< for the record
  std::string only, scene;  ///< submissions whose name contains this; the one scene that is graded; empty: all
  std::uint64_t seed = 1;
  int threads = 0;        ///< what programs are told of cores, 0: all there are
  bool resume = false;    ///< use what an interrupted grading left
  bool fresh = false;     ///< make references anew, too
  bool contained = true;  ///< false: --no-sandbox
  bool timing = true;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const std::string&)> progress;   ///< one line about what is going on
  std::function<void(const SubmissionGrade&)> heard;  ///< of each submission whose images are judged
};

/// Throws InputError for an assignment, submission file or folder that cannot be used, before anything is run, and
/// where the baseline cannot be built or run. Whatever a submission does is part of its grade.
Grades grade_submissions(const Assignment& assignment, const GradeOptions& options);

}  // namespace photonproof::inline harness_grading
