// A disk that is slow or fails, simulated in the system calls of one command and all its descendants. The kernel
// reports each call that writes, makes, renames or removes a file (seccomp_unotify(2)), and we delay it or let it fail.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

struct BadDisk {
  double delay_seconds = 0;                     ///< For every such call.
  std::optional<double> fails_after_seconds{};  ///< From then on, calls that concern `folder` fail with EIO.
  std::filesystem::path folder{};               ///< Absolute.
};

/// The exit code of run_on_bad_disk where this system does not let us intercept calls.
inline constexpr int no_bad_disk_exit_code = 97;

/// Runs the command to its end, looked up on PATH; its exit code, or 128 and the signal that ended it.
int run_on_bad_disk(const BadDisk& disk, const std::vector<std::string>& argv);

}  // namespace photonproof::inline harness_stress_faults
