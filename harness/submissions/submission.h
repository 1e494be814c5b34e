// A submission is an untrusted program, as a folder, an archive or a git bundle. The grader takes in a private copy:
// unpacked inside the sandbox, then checked from outside, so that no part of it lies or points elsewhere.
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

/// An error in a submission, as a sentence for its author. Failures of the grader itself are InputErrors.
class SubmissionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct IntakeLimits {
  double seconds = 60;
  std::uint64_t bytes = std::uint64_t{512} << 20;  ///< unpacked
  int files = 20000;                               ///< folders and links counted
};

/// How all parts of a submission run.
struct Handling {
  bool contained = true;  ///< false: without a sandbox
  const std::atomic<bool>* interrupt = nullptr;
};

/// Unpacks a copy into `folder`, which must not exist yet; an archive's only folder is entered. The source is not
/// changed. Throws SubmissionError for a file of another kind, a damaged one, or one over the limits. Links that lead
/// outside, devices, pipes and sockets are also refused. Throws InputError when the source is missing or the copy
/// cannot be written.
void take_in(const Submission& submission, const std::filesystem::path& folder, const IntakeLimits& limits = {},
             const Handling& handling = {});

}  // namespace photonproof::inline harness_submissions
