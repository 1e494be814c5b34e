// Scratch memory of the path kernel, kept from tile to tile: clearing it again would take much of a short tile's time.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "renderer/kernels/tasks.h"

namespace photonproof::inline renderer_passes {

class ScratchPool {
 public:
  explicit ScratchPool(const PathKernelEntry& kernel) : kernel_(kernel) {}

  /// Traces the paths with memory that no other thread uses meanwhile. It is zero at first, later as the previous task
  /// left it. Those lanes are as harmless to load as zeros: indices in them are of the same scene.
  void trace(PathTask& task) {
    std::unique_ptr<std::uint32_t[]> scratch = take();
    task.scratch = scratch.get();
    kernel_.trace(task);
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(scratch));
  }

 private:
  std::unique_ptr<std::uint32_t[]> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<std::uint32_t[]> scratch = std::move(free_.back());
        free_.pop_back();
        return scratch;
      }
    }
    return std::make_unique<std::uint32_t[]>(kernel_.scratch);
  }

  const PathKernelEntry& kernel_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<std::uint32_t[]>> free_;
};

}  // namespace photonproof::inline renderer_passes
