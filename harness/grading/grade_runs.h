// One run of a program on a scene, kept under all its inputs. An interrupted grading resumes from kept runs, and
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
  std::uint64_t seed = 1;  ///< Seed of the session.
  int threads = 1;         ///< The number of threads given to programs.
  const std::atomic<bool>* interrupt = nullptr;
};

class GradeRuns {
 public:
  /// `folder` is that of grades.json. It exists and is locked by the caller, and receives cells/ (image_store.h).
  GradeRuns(const Assignment& assignment, const SubmissionRunner& runner, const std::filesystem::path& folder,
            const GradeRunsOptions& options)
      : assignment_(assignment), runner_(runner), folder_(folder), store_(folder), options_(options) {}

  /// Run number `number` of a purpose ("correctness", "reference"), which decides its seed: from a cell if `reuse` is
  /// set, else anew. Several may run side by side. One that reaches its time limit beside others is repeated alone. If
  /// other work used the machine meanwhile, it runs once more, with as much more time as its share of the machine
  /// requires. Empty when interrupted.
  std::optional<DrawnRun> run(const PreparedSubmission& submission, const WorkScene& scene, const std::string& purpose,
                              std::size_t number, bool reuse);

  /// Like run number `number` of "correctness", but in the place of the previous run, which may have left files. If the
  /// place is `littered`, that run's image is there, too.
  std::optional<DrawnRun> run_in_used_place(const PreparedSubmission& submission, const WorkScene& scene,
                                            std::size_t number, bool littered, bool reuse);

  /// A timed run: like `run`, but always anew, alone and not kept.
  std::optional<DrawnRun> run_timed(const PreparedSubmission& submission, const WorkScene& scene, std::size_t number);

  /// Seeds of correctness runs, timed runs and references: never equal. A positive number of at most nine digits.
  std::uint64_t seed_of(const std::string& purpose, std::size_t number) const;

  bool is_interrupted() const { return options_.interrupt != nullptr && *options_.interrupt; }

 private:
  std::optional<DrawnRun> run_kept(const PreparedSubmission& submission, const WorkScene& scene,
                                   const SubmissionRunRequest& request, std::uint64_t seed, bool reuse);
  std::optional<DrawnRun> run_once(const PreparedSubmission& submission, const WorkScene& scene,
                                   const SubmissionRunRequest& request, std::uint64_t seed) const;
  /// Runs beside the machine's other work, but alone among our own.
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
