// A disk that is slow or fails, made of the system calls of one command and of all that descends from it: the kernel
// asks us about each that writes, makes, renames or removes a file (seccomp_unotify(2)), and we let it wait or fail.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_faults {

struct BadDisk {
  double delay_seconds = 0;                     ///< of every such call
  std::optional<double> fails_after_seconds{};  ///< from then on, calls that concern `folder` fail with EIO
  std::filesystem::path folder{};               ///< absolute
};

/// The exit code of run_on_bad_disk where this system does not let us be asked.
inline constexpr int no_bad_disk_exit_code = 97;

/// Runs the command to its end, looked up on PATH; its exit code, or 128 and the signal that ended it.
int run_on_bad_disk(const BadDisk& disk, const std::vector<std::string>& argv);

}  // namespace photonproof::inline harness_stress_faults
