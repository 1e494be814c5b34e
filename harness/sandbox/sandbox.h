// Runs one command of somebody whom nobody trusts. Namespaces are bubblewrap's (bwrap(1)): the command has no network,
// sees no process but its own and no file but a read-only system, what is mounted for it, and one file system in memory
// that holds its working folder, /tmp and /dev/shm. That one ends with it, so its size is the limit on disk, exactly,
// and nothing is left for the next command. The uid is its own: where we are root it is nobody's outside either, else
// it is ours but in a user namespace without rights. syscall_filter.h closes what namespaces leave open;
// control_groups.h limits memory and processes where the system lets us, rlimits and samples of run_process do
// everywhere. The working folder's results are collected after every process of the command is dead.
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
  double wall_seconds = 60;                             ///< of everything, copying into and out of the sandbox too
  double cpu_seconds = 0;                               ///< of one process, rounded up; 0: only the wall's
  std::uint64_t memory_bytes = std::uint64_t{2} << 30;  ///< resident, of all processes together
  std::uint64_t file_bytes = std::uint64_t{64} << 20;   ///< of one file that is written
  std::uint64_t disk_bytes = std::uint64_t{256} << 20;  ///< of all files that are written; they are in memory
  std::uint64_t log_bytes = std::uint64_t{4} << 20;     ///< of standard output and error together
  int processes = 64;                                   ///< at one time, threads counted
};

/// What the command sees at `inside`, two folders deep at most, read-only. Not in a run that is not contained.
struct SandboxMount {
  std::filesystem::path outside, inside;
};

struct SandboxOptions {
  std::vector<SandboxMount> mounts{};
  /// Where the command starts, inside; it may write there, in /tmp, its home, and in /dev/shm.
  std::filesystem::path working_folder = "/work";
  /// A folder outside, whose tree is copied into the working folder before; its links are not followed.
  std::filesystem::path starts_with{};
  /// A name in the working folder that is copied to `collect_to` when the command has ended with 0: a regular file if
  /// it is one of at most `file_bytes`. "." is the folder's whole tree, without devices, pipes and sockets, to an
  /// existing folder. Empty: nothing.
  std::string collect{};
  std::filesystem::path collect_to{};
  std::map<std::string, std::string> environment{};  ///< besides PATH, HOME, TMPDIR and LANG
  SandboxLimits limits{};
  const std::atomic<bool>* interrupt = nullptr;
  bool contained = true;  ///< false: the limits alone, at the caller's risk; the working folder is then one outside
};

struct SandboxOutcome {
  ProcessOutcome process;  ///< wall_seconds is the command's own, without copying
  /// Which limit was met: "time", "processor time", "memory", "processes", "file size", "disk", "log"; else empty.
  std::string limit;
  /// What was to be collected was: "regular file", "regular empty file", "symbolic link", "fifo", "directory" ... as
  /// stat(1) says, or empty where there was nothing or the command failed.
  std::string collected_kind;
  bool collected = false;
  std::string special;  ///< a device, pipe or socket that the tree had and that was left out; relative; else empty
  bool ok() const { return process.ok() && limit.empty(); }
  std::string sentence() const;  ///< "killed by SIGSEGV", "used more than 64 MiB of memory (limit)" ...
};

/// Empty where commands can be contained, else why not, in a sentence. Found out once, by containing one.
std::optional<std::string> why_no_sandbox();

/// Whether every contained command could read what lies there, because it is part of the system.
bool is_part_of_system(const std::filesystem::path& path);

/// argv[0] with a '/' is relative to the working folder, else looked up on PATH. No shell. Throws InputError when
/// nothing can be contained but `contained` asks for it, and when `collect_to` cannot be written; never for what the
/// command does. May be called on several threads at once.
SandboxOutcome run_sandboxed(const std::vector<std::string>& argv, const SandboxOptions& options);

}  // namespace photonproof::inline harness_sandbox
