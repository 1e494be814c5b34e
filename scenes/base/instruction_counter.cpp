#include "scenes/base/instruction_counter.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>

namespace photonproof::inline scenes_base {

InstructionCounter::~InstructionCounter() {
  if (descriptor_ >= 0) close(descriptor_);
}

void InstructionCounter::attach(pid_t pid) {
  perf_event_attr attributes{};
  attributes.size = sizeof attributes;
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.disabled = 1;
  attributes.enable_on_exec = 1;
  attributes.inherit = 1;
  // The kernel's own work depends on other processes, and an ordinary user may not count it.
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  descriptor_ = static_cast<int>(syscall(SYS_perf_event_open, &attributes, pid, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

std::optional<std::uint64_t> InstructionCounter::count() const {
  struct {
    std::uint64_t value = 0, time_enabled = 0, time_running = 0;
  } counted;
  if (descriptor_ < 0 || read(descriptor_, &counted, sizeof counted) != sizeof counted) return std::nullopt;
  if (counted.value == 0 || counted.time_running < counted.time_enabled) return std::nullopt;
  return counted.value;
}

}  // namespace photonproof::inline scenes_base
