// Control groups (cgroups(7)) of either version for one contained command, where the system allows them. The kernel
// then counts its memory and processes. Otherwise there are samples, and a limit for each process alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenes/files/folder_hold.h"

namespace photonproof::inline harness_sandbox {

/// The folder where the kernel shows the groups. Their files come and go with a group, so making one is more than
/// making a folder.
struct ControlGroupTree {
  std::filesystem::path root = "/sys/fs/cgroup";
  std::filesystem::path own_groups = "/proc/self/cgroup";  ///< lines "number:controllers:path"
  std::function<bool(const std::filesystem::path&)> make, remove;

  ControlGroupTree();  ///< the system's tree
};

class ControlGroups {
 public:
  /// Makes groups below the caller's own, or above them if only those allow children; no group if none can be made.
  ControlGroups(std::uint64_t memory_bytes, int processes, ControlGroupTree tree = {});
  ~ControlGroups();  ///< the command must have ended
  ControlGroups(const ControlGroups&) = delete;
  ControlGroups& operator=(const ControlGroups&) = delete;

  /// A process that writes "0" to `cgroup.procs` in each is limited, and so are all its descendants.
  const std::vector<std::filesystem::path>& folders() const { return folders_; }
  bool counts_memory() const { return !memory_.empty(); }
  bool counts_processes() const { return !processes_.empty(); }
  /// Whether the kernel has killed a process for memory, or refused a new one.
  bool memory_ran_out() const;
  bool processes_ran_out() const;

 private:
  ControlGroupTree tree_;
  std::vector<std::filesystem::path> folders_;
  std::vector<FolderHold> holds_;
  std::filesystem::path memory_, processes_;
};

}  // namespace photonproof::inline harness_sandbox
