// Runs one untrusted command. Namespaces are bubblewrap's (bwrap(1)). The command has no network and sees only its own
// processes. It sees a read-only system, its mounts, and one file system in memory that holds its working folder, /tmp
// and /dev/shm. That file system ends with the command, so its size is exactly the limit on disk, and nothing is left
// for the next one. The command has a uid of its own. If we are root, no user outside has that uid; else it is ours, in
// a user namespace without rights. syscall_filter.h closes what namespaces leave open. Memory and processes are limited
// by control_groups.h where the system allows it, else by rlimits and samples of run_process. The working folder's
// results are collected after every process of the command is dead.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/base/process.h"

namespace photonproof::inline harness_sandbox {

struct SandboxLimits {
  double wall_seconds = 60;                             ///< of everything, including copies into and out of the sandbox
  double cpu_seconds = 0;                               ///< of one process, rounded up; 0: only the wall limit
  std::uint64_t memory_bytes = std::uint64_t{2} << 30;  ///< resident, of all processes together
  std::uint64_t file_bytes = std::uint64_t{64} << 20;   ///< of one file that is written
  std::uint64_t disk_bytes = std::uint64_t{256} << 20;  ///< of all files that are written; they are in memory
  std::uint64_t log_bytes = std::uint64_t{4} << 20;     ///< of standard output and error together
  int processes = 64;                                   ///< at one time, threads counted
};

/// A file or folder that the command sees at `inside`, at most two folders deep, read-only. Only in a contained run.
struct SandboxMount {
  std::filesystem::path outside, inside;
};

struct SandboxOptions {
  std::vector<SandboxMount> mounts{};
  /// The folder inside where the command starts. It may write there, in /tmp (its home) and in /dev/shm.
  std::filesystem::path working_folder = "/work";
  /// A folder outside, whose tree is copied into the working folder first; its links are not followed.
  std::filesystem::path starts_with{};
  /// A name in the working folder that is copied to `collect_to` after the command has ended with 0, if it is a regular
  /// file of at most `file_bytes`. "." copies the folder's whole tree, without devices, pipes and sockets, to an
  /// existing folder. Empty: nothing.
  std::string collect{};
  std::filesystem::path collect_to{};
  std::map<std::string, std::string> environment{};  ///< besides PATH, HOME, TMPDIR and LANG
  SandboxLimits limits{};
  const std::atomic<bool>* interrupt = nullptr;
  bool contained = true;  ///< false: only the limits, at the caller's risk; working_folder is then outside
};

struct SandboxOutcome {
  ProcessOutcome process;  ///< wall_seconds is the command's own, without copying
  /// The limit that was met: "time", "processor time", "memory", "processes", "file size", "disk", "log"; else empty.
  std::string limit;
  /// Kind of the file to collect, as in stat(1): "regular file", "regular empty file", "symbolic link", "fifo",
  /// "directory" ... Empty if there was no file or the command failed.
  std::string collected_kind;
  bool collected = false;
  std::string special;  ///< relative path of the first device, pipe or socket left out of the tree; empty: none
  bool ok() const { return process.ok() && limit.empty(); }
  std::string sentence() const;  ///< "killed by SIGSEGV", "used more than 64 MiB of memory (limit)" ...
};

/// Empty if commands can be contained, else the reason as a sentence. Tested once, by containing a command.
std::optional<std::string> why_no_sandbox();

/// Whether the path is part of the system, so that every contained command could read it.
bool is_part_of_system(const std::filesystem::path& path);

/// Runs without a shell; argv[0] with a '/' is relative to the working folder, else looked up on PATH. Throws
/// InputError if `contained` is set but containing is impossible, or if `collect_to` cannot be written; never because
/// of the command. May be called on several threads at once.
SandboxOutcome run_sandboxed(const std::vector<std::string>& argv, const SandboxOptions& options);

}  // namespace photonproof::inline harness_sandbox
