// Counts the instructions a child process and its descendants retire in user mode, through the kernel's performance
// counters (perf_event_open). Many virtual machines and containers have none.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace photonproof::inline scenes_base {

class InstructionCounter {
 public:
  InstructionCounter() = default;
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  ~InstructionCounter();

  /// Counts from the next exec of `pid` on; must be called before that. Without a counter in the kernel, it does
  /// nothing.
  void attach(pid_t pid);

  /// Call after waiting for the process. Empty where nothing was counted, or only part of the time because other
  /// programs used the processor's counters, too.
  std::optional<std::uint64_t> count() const;

 private:
  int descriptor_ = -1;
};

}  // namespace photonproof::inline scenes_base
