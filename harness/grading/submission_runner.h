// The boundary between grading and untrusted programs: a submission is taken in and built once, then run as often as
// verdicts and timings need. All failures beyond it end as a sentence.
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

/// A submission or the baseline, after it is taken in and after its build.
struct PreparedSubmission {
  std::string name;
  std::filesystem::path source, folder;  ///< The given path, and the folder of the build.
  std::string checksum;  ///< Checksum of the submitted files and build commands; empty where it cannot be taken in.
  bool built = false;
  std::string sentence;  ///< The reason where it is not built.
  std::string log_tail;
  double seconds = 0;
};

/// One run. Its command has all placeholders filled except {output}, {params} and {scene}, which the sandbox knows. The
/// runner fills in limits and the scene's folder.
struct SubmissionRunRequest {
  RunRecipe recipe{};
  SceneFolder scene{};        ///< For {scene}.
  int width = 0, height = 0;  ///< Pixels that the image must have.
  double more_time = 1;       ///< Factor on the assignment's limit on wall time.
};

/// A finished run, and its image, linear, top row first, where its end is "ok".
struct DrawnRun {
  GradedRun run;
  std::optional<Image> image;
};

struct SubmissionRunnerOptions {
  bool contained = true;  ///< False: --no-sandbox.
  int threads = 1;
  std::filesystem::path program;  ///< This program, which reads images in a process of its own.
  const std::atomic<bool>* interrupt = nullptr;
};

class SubmissionRunner {
 public:
  /// Throws InputError where a sandbox is required but not available.
  SubmissionRunner(const Assignment& assignment, const SubmissionRunnerOptions& options);

  /// Takes a submission into source/ of the folder, replacing an old one; does not build it yet. Never throws for its
  /// content.
  PreparedSubmission take(const std::string& name, const std::filesystem::path& source,
                          const std::filesystem::path& folder) const;
  /// Builds a submission in built/ of the folder, replacing an old build. With `reuse` it takes an earlier build of the
  /// same submission by the same commands. A build that reaches its time limit while other work uses the machine is
  /// repeated once with more time. Never throws for a submission's failures.
  void build(PreparedSubmission& submission, bool reuse) const;
  /// The same submission without staff's files over its own; empty where these are equal, or the build then fails.
  std::optional<PreparedSubmission> built_as_handed_in(const PreparedSubmission& submission) const;
  /// The run has no seed. Its end is "interrupted" after an interruption. Throws InputError for failures of the grader
  /// itself.
  DrawnRun run(const PreparedSubmission& submission, const SubmissionRunRequest& request) const;

  /// Reads a picture from staff in the assignment's format, like a submission's image. Throws InputError where it is
  /// none.
  Image read_given(const std::filesystem::path& file, int width, int height) const;

  /// The separation of programs from this machine, for the record.
  std::string containment() const;

 private:
  Handling handling() const { return {options_.contained, options_.interrupt}; }
  BuildRecipe recipe() const;

  const Assignment& assignment_;
  SubmissionRunnerOptions options_;
};

}  // namespace photonproof::inline harness_grading
