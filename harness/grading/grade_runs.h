// One run of a program on a scene, kept by all it follows from, so that an interrupted grading goes on where it was and
// references are made once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <shared_mutex>
#include <string>

#include "harness/grading/submission_runner.h"
#include "harness/grading/work_scenes.h"
#include "harness/images/image_store.h"

namespace photonproof::inline harness_grading {

struct GradeRunsOptions {
  std::uint64_t seed = 1;  ///< of the session
  int threads = 1;         ///< what programs are told
  const std::atomic<bool>* interrupt = nullptr;
};

class GradeRuns {
 public:
  /// `folder` is that of grades.json, which exists and is locked by the caller; receives cells/ (image_store.h).
  GradeRuns(const Assignment& assignment, const SubmissionRunner& runner, const std::filesystem::path& folder,
            const GradeRunsOptions& options)
      : assignment_(assignment), runner_(runner), folder_(folder), store_(folder), options_(options) {}

  /// Run number `number` of a purpose ("correctness", "reference"), which decides its seed: from a cell where `reuse`
  /// says so, else anew. Several may run side by side; one that meets its limit on time in company is repeated alone
  /// before that is said of it, and if other work had the machine meanwhile, once more with as much more time as it
  /// takes to get what it would have of an idle one. Empty when interrupted.
  std::optional<DrawnRun> run(const PreparedSubmission& submission, const WorkScene& scene, const std::string& purpose,
                              std::size_t number, bool reuse);

  /// As run number `number` of "correctness", but in the place where the one before it has run and may have left
  /// files; its image, too, where the place is `littered`.
  std::optional<DrawnRun> run_in_used_place(const PreparedSubmission& submission, const WorkScene& scene,
                                            std::size_t number, bool littered, bool reuse);

  /// As `run`, always anew, alone and not kept: a timed one.
  std::optional<DrawnRun> run_timed(const PreparedSubmission& submission, const WorkScene& scene, std::size_t number);

  /// Of correctness and timed runs, and of references: never the same. A positive number of at most nine digits.
  std::uint64_t seed_of(const std::string& purpose, std::size_t number) const;

  bool is_interrupted() const { return options_.interrupt != nullptr && *options_.interrupt; }

 private:
  std::optional<DrawnRun> run_kept(const PreparedSubmission& submission, const WorkScene& scene,
                                   const SubmissionRunRequest& request, std::uint64_t seed, bool reuse);
  std::optional<DrawnRun> run_once(const PreparedSubmission& submission, const WorkScene& scene,
                                   const SubmissionRunRequest& request, std::uint64_t seed) const;
  /// Alone among our own.
  std::optional<DrawnRun> run_beside_others(const PreparedSubmission& submission, const WorkScene& scene,
                                            SubmissionRunRequest request, std::uint64_t seed) const;
  std::string key_of(const PreparedSubmission& submission, const SubmissionRunRequest& request) const;
  std::optional<DrawnRun> find(const std::string& key) const;
  /// Sets run.image.
  void keep(const std::string& key, DrawnRun& drawn);

  const Assignment& assignment_;
  const SubmissionRunner& runner_;
  std::filesystem::path folder_;
  ImageStore store_;
  GradeRunsOptions options_;
  std::shared_mutex concurrent_runs_;
};

}  // namespace photonproof::inline harness_grading
