// The process between us and a child that we run: orphans of the child, in whatever session or group they are, become
// children of the keeper (prctl(2), PR_SET_CHILD_SUBREAPER), so that it can end all of them, also when we are killed.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <functional>

namespace photonproof::inline scenes_base {

/// What the keeper writes to `report`, in this order: one `KeeperStart` when there is a child or why there is none, one
/// `KeeperEnd` when the child has ended, and nothing after it has ended all others.
struct KeeperStart {
  pid_t child = 0;
  int error = 0;  ///< errno where there is no child
};
struct KeeperEnd {
  int status = 0;  ///< as of waitpid
  rusage usage{};  ///< of the child and the children it waited for
};

/// What we write to `orders`; its end of file means `kill`.
enum class KeeperOrder : char {
  interrupt,  ///< SIGINT to the child's group
  kill,       ///< SIGKILL to all
};

/// The keeper's side of fork: forks the child, whose side is `become` (it never returns), and leaves when no process is
/// left that descends from it, or those left cannot be killed. `orders` and `report` are pipes, whose other ends are
/// closed already; every other descriptor is closed here. Never returns; only async-signal-safe calls.
[[noreturn]] void keep_child(int orders, int report, const std::function<void(pid_t keeper)>& become);

}  // namespace photonproof::inline scenes_base
