// The door between grading and untrusted programs: a submission is taken in and built once, then run as often as
// verdicts and timings need. Everything that happens on its other side ends as a sentence.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "harness/grading/scene_folder.h"
#include "harness/submissions/build_submission.h"
#include "harness/submissions/run_submission.h"
#include "reports/grades/grade_record.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_grading {

/// A submission, or the baseline: taken in, and after its build.
struct PreparedSubmission {
  std::string name;
  std::filesystem::path source, folder;  ///< as given; where it was built
  std::string checksum;  ///< of what was handed in and how it is built; empty where it cannot be taken in
  bool built = false;
  std::string sentence;  ///< why not
  std::string log_tail;
  double seconds = 0;
};

/// One run. Its command has all placeholders filled but {output}, {params} and {scene}, which the sandbox knows. The
/// door fills in limits and the scene's folder.
struct SubmissionRunRequest {
  RunRecipe recipe{};
  SceneFolder scene{};        ///< for {scene}
  int width = 0, height = 0;  ///< pixels that the image must have
  double more_time = 1;       ///< times the assignment's limit on wall time
};

/// A run that has ended, and its image, linear, top row first, where its end is "ok".
struct DrawnRun {
  GradedRun run;
  std::optional<Image> image;
};

struct SubmissionRunnerOptions {
  bool contained = true;  ///< false: --no-sandbox
  int threads = 1;
  std::filesystem::path program;  ///< this one, which reads images in a process of its own
  const std::atomic<bool>* interrupt = nullptr;
};

class SubmissionRunner {
 public:
  /// Throws InputError where no sandbox can be had and one is asked for.
  SubmissionRunner(const Assignment& assignment, const SubmissionRunnerOptions& options);

  /// Takes a submission in, into source/ of the folder, in place of what is there; it is not built yet. Never throws
  /// for what it holds.
  PreparedSubmission take(const std::string& name, const std::filesystem::path& source,
                          const std::filesystem::path& folder) const;
  /// Builds what was taken in, into built/ of the folder, in place of what is there; with `reuse`, what was built there
  /// before of the same submission in the same way is taken. What meets its limit on time while other work has the
  /// machine is built once more, with more of it. Never throws for what a submission does.
  void build(PreparedSubmission& submission, bool reuse) const;
  /// The same submission without staff's files over its own; empty where these are the same, or it is not built then.
  std::optional<PreparedSubmission> built_as_handed_in(const PreparedSubmission& submission) const;
  /// The run has no seed; its end is "interrupted" where that ended it. Throws InputError for the grader's own
  /// troubles.
  DrawnRun run(const PreparedSubmission& submission, const SubmissionRunRequest& request) const;

  /// A picture that staff name in the assignment's format, as a submission's image is read. Throws InputError where it
  /// is none.
  Image read_given(const std::filesystem::path& file, int width, int height) const;

  /// How programs are kept apart from this machine, for the record.
  std::string containment() const;

 private:
  Handling handling() const { return {options_.contained, options_.interrupt}; }
  BuildRecipe recipe() const;

  const Assignment& assignment_;
  SubmissionRunnerOptions options_;
};

}  // namespace photonproof::inline harness_grading
