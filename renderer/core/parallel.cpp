#include "renderer/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "scenes/base/thread_handoff.h"

namespace photonproof::inline renderer_core {

Threads::Threads(int count) : count_(count > 0 ? count : tbb::this_task_arena::max_concurrency()) {}

void Threads::for_each(std::size_t n, const std::function<void(std::size_t)>& body) const {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_));
  tbb::task_arena arena(count_);
  const char begun = 0, ended = 0;  // names of what comes before what
  const auto work = [&](std::size_t i) PHOTONPROOF_CALLED_BY_LIBRARY {
    takes_over(&begun);
    body(i);
    hands_over(&ended);
  };
  hands_over(&begun);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, n, work, tbb::simple_partitioner()); });
  takes_over(&ended);
}

std::size_t Threads::for_each_in_order(std::size_t first, std::size_t n, const std::function<bool()>& stop,
                                       const std::function<void(std::size_t)>& body,
                                       const std::function<void(std::size_t)>& commit) const {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_));
  tbb::task_arena arena(count_);
  std::size_t next = first;
  const char begun = 0, worked = 0, committed = 0;  // names of what comes before what
  const auto begin = [&](tbb::flow_control& control) PHOTONPROOF_CALLED_BY_LIBRARY -> std::size_t {
    takes_over(&begun);
    takes_over(&committed);
    const std::size_t i = next < n && !stop() ? next++ : n;
    if (i == n) control.stop();
    hands_over(&begun);
    return i;
  };
  const auto work = [&](std::size_t i) PHOTONPROOF_CALLED_BY_LIBRARY {
    takes_over(&begun);
    body(i);
    hands_over(&worked);
    return i;
  };
  const auto finish = [&](std::size_t i) PHOTONPROOF_CALLED_BY_LIBRARY {
    takes_over(&worked);
    takes_over(&committed);
    commit(i);
    hands_over(&committed);
  };
  hands_over(&begun);
  arena.execute([&] {
    tbb::parallel_pipeline(in_flight(),
                           tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, begin) &
                               tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, work) &
                               tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, finish));
  });
  takes_over(&begun);
  takes_over(&committed);
  return next;
}

Tiles::Tiles(const Tile& window)
    : window_(window),
      across_(static_cast<std::size_t>((window.width() + size - 1) / size)),
      down_(static_cast<std::size_t>((window.height() + size - 1) / size)) {}

Tile Tiles::at(std::size_t i) const {
  const int x0 = window_.x0 + static_cast<int>(i % across_) * size;
  const int y0 = window_.y0 + static_cast<int>(i / across_) * size;
  return {x0, y0, std::min(x0 + size, window_.x1), std::min(y0 + size, window_.y1)};
}

}  // namespace photonproof::inline renderer_core
