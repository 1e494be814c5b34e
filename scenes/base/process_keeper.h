// The keeper is the process between us and a child that we run. The child's orphans, in any session or group, become
// the keeper's children (prctl(2), PR_SET_CHILD_SUBREAPER). So it can end all of them, also when we are killed.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <functional>

namespace photonproof::inline scenes_base {

/// The keeper's messages on `report`: first a `KeeperStart`, with the child or the error. When the child has ended, a
/// `KeeperEnd` follows, and the end of file when all others have ended.
struct KeeperStart {
  pid_t child = 0;
  int error = 0;  ///< errno where there is no child
};
struct KeeperEnd {
  int status = 0;  ///< as of waitpid
  rusage usage{};  ///< of the child and the children it waited for
};

/// Our messages on `orders`; its end of file means `kill`.
enum class KeeperOrder : char {
  interrupt,  ///< SIGINT to the child's group
  kill,       ///< SIGKILL to all
};

/// The keeper's side of fork. It forks the child, which runs `become` (this never returns). It ends when no descendant
/// of the child is left, or those left cannot be killed. `orders` and `report` are pipes, whose other ends are closed
/// already; every other descriptor is closed here. Never returns; only async-signal-safe calls.
[[noreturn]] void keep_child(int orders, int report, const std::function<void(pid_t keeper)>& become);

}  // namespace photonproof::inline scenes_base
