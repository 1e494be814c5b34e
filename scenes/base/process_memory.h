// Memory of a running process tree, read from /proc: for the limit and the peak of run_process.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace photonproof::inline scenes_base {

struct MemorySample {
  std::uint64_t resident_bytes = 0;      ///< sum over the tree now; pages that processes share count in each
  std::uint64_t largest_peak_bytes = 0;  ///< high-water mark of the process that has the highest
};

/// The tree is all descendants of `keeper` (process_keeper.h), in any group or session, without itself. Zeroes when
/// none is left. Costs about 10 us for each process of the machine.
MemorySample sample_memory(pid_t keeper);

/// This process's own high-water mark; 0 when /proc does not have it.
std::uint64_t own_peak_bytes();

}  // namespace photonproof::inline scenes_base
