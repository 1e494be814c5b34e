// Tests whether a submission uses the files that staff put over its own before the build, such as a header of
// parameters. Built once more with its own files, it must draw another image.
#pragma once

#include "harness/diagnosis/lazy.h"
#include "harness/grading/grade_flags.h"
#include "harness/grading/grade_runs.h"

namespace photonproof::inline harness_grading {

class ParameterProbe {
 public:
  /// `reuse`: use the runs of an interrupted grading.
  ParameterProbe(const FlagContext& context, const SubmissionRunner& runner, GradeRuns& runs,
                 const PreparedSubmission& baseline, bool reuse);

  /// Adds the flag "parameters-ignored" to a submission whose first scene is wrong in a way that parameters explain.
  /// With its own files, too, it must draw that image bit for bit, while the baseline does not. Builds and runs; call
  /// it once scenes have their findings. Threads may call it at once for different submissions.
  void flag(const PreparedSubmission& prepared, SubmissionWork& work) const;

 private:
  bool draws_the_same(const PreparedSubmission& prepared, const SubmissionWork& work) const;

  const FlagContext& context_;
  const SubmissionRunner& runner_;
  GradeRuns& runs_;
  bool reuse_;
  std::size_t scene_ = 0;  ///< the first graded scene
  Lazy<bool> baseline_draws_the_same_;
};

}  // namespace photonproof::inline harness_grading
