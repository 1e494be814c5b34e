// Do a submission's images follow from the files that staff put over its own before the build, as a header of
// parameters? Built once more with its own files, it must draw another image.
#pragma once

#include "harness/diagnosis/lazy.h"
#include "harness/grading/grade_flags.h"
#include "harness/grading/grade_runs.h"

namespace photonproof::inline harness_grading {

class ParameterProbe {
 public:
  /// `reuse`: runs that an interrupted grading left.
  ParameterProbe(const FlagContext& context, const SubmissionRunner& runner, GradeRuns& runs,
                 const PreparedSubmission& baseline, bool reuse);

  /// Adds the flag "parameters-ignored" where a submission is wrong on the first scene as too few photons or too low a
  /// depth may be wrong, and draws that image bit for bit with its own files, too, though the baseline does not. Builds
  /// and runs; to be called when scenes have their findings. Threads may call it side by side, of different ones.
  void flag(const PreparedSubmission& prepared, SubmissionWork& work) const;

 private:
  bool draws_the_same(const PreparedSubmission& prepared, const SubmissionWork& work) const;

  const FlagContext& context_;
  const SubmissionRunner& runner_;
  GradeRuns& runs_;
  bool reuse_;
  std::size_t scene_ = 0;  ///< the first one that is graded
  Lazy<bool> baseline_draws_the_same_;
};

}  // namespace photonproof::inline harness_grading
