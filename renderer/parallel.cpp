#include "renderer/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace photonproof {

Threads::Threads(int count) : count_(count > 0 ? count : tbb::this_task_arena::max_concurrency()) {}

void Threads::for_each(std::size_t n, const std::function<void(std::size_t)>& body) const {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_));
  tbb::task_arena arena(count_);
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, n, [&](std::size_t i) { body(i); }, tbb::simple_partitioner());
  });
}

void for_each_tile(const Threads& threads, int width, int height, const std::function<void(const Tile&)>& body) {
  constexpr int size = 16;
  const int across = (width + size - 1) / size;
  const int down = (height + size - 1) / size;
  threads.for_each(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), [&](std::size_t i) {
    const int x0 = static_cast<int>(i) % across * size;
    const int y0 = static_cast<int>(i) / across * size;
    body({x0, y0, std::min(x0 + size, width), std::min(y0 + size, height)});
  });
}

}  // namespace photonproof
