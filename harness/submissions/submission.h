// A submission is somebody's program, as a folder, an archive or a git bundle. Taking it in means a copy that only the
// grader has: unpacked inside the sandbox, then looked at from outside, so that nothing of it lies or points elsewhere.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace photonproof::inline harness_submissions {

struct Submission {
  std::string name;
  std::filesystem::path source;  ///< a folder, .zip, .tar, .tar.gz, .tar.bz2, .tar.xz, .tar.zst or a git bundle
};

/// What is wrong with a submission, in a sentence for its author. The grader's own troubles are InputErrors.
class SubmissionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct IntakeLimits {
  double seconds = 60;
  std::uint64_t bytes = std::uint64_t{512} << 20;  ///< unpacked
  int files = 20000;                               ///< folders and links counted
};

/// How everything of a submission is run.
struct Handling {
  bool contained = true;  ///< false: without a sandbox
  const std::atomic<bool>* interrupt = nullptr;
};

/// Unpacks a copy into `folder`, which is made and must not exist; an archive's only folder is entered. The source is
/// not changed. Throws SubmissionError for what is no such file, is damaged, has members or links that lead outside,
/// devices, pipes or sockets, or exceeds the limits, and InputError when the source is missing or the copy cannot be
/// written.
void take_in(const Submission& submission, const std::filesystem::path& folder, const IntakeLimits& limits = {},
             const Handling& handling = {});

}  // namespace photonproof::inline harness_submissions
