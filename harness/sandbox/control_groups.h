// Control groups (cgroups(7)) for one contained command, of either version, where the system lets us make them: the
// kernel then counts its memory and processes, instead of our samples and a limit that each process has for itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenes/files/folder_hold.h"

namespace photonproof::inline harness_sandbox {

/// Where the kernel shows them. Making and removing a group is more than making a folder: files come and go with it.
struct ControlGroupTree {
  std::filesystem::path root = "/sys/fs/cgroup";
  std::filesystem::path own_groups = "/proc/self/cgroup";  ///< lines "number:controllers:path"
  std::function<bool(const std::filesystem::path&)> make, remove;

  ControlGroupTree();  ///< the system's
};

class ControlGroups {
 public:
  /// Below the caller's own groups, or above them where only there children are allowed; none where nothing can be
  /// made.
  ControlGroups(std::uint64_t memory_bytes, int processes, ControlGroupTree tree = {});
  ~ControlGroups();  ///< the command must have ended
  ControlGroups(const ControlGroups&) = delete;
  ControlGroups& operator=(const ControlGroups&) = delete;

  /// A process that writes "0" to `cgroup.procs` in each is limited, and all that descend from it.
  const std::vector<std::filesystem::path>& folders() const { return folders_; }
  bool counts_memory() const { return !memory_.empty(); }
  bool counts_processes() const { return !processes_.empty(); }
  /// Whether the kernel has killed for memory, or refused another process.
  bool memory_ran_out() const;
  bool processes_ran_out() const;

 private:
  ControlGroupTree tree_;
  std::vector<std::filesystem::path> folders_;
  std::vector<FolderHold> holds_;
  std::filesystem::path memory_, processes_;
};

}  // namespace photonproof::inline harness_sandbox
