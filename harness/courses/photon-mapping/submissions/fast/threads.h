// Runs work on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

/// work(i) for every i from 0 to count - 1, in any order.
template <class Work>
void for_each(int count, const Work& work) {
  std::atomic<int> next{0};
  auto loop = [&] {
    for (int i; (i = next++) < count;) work(i);
  };
  int others = std::min<int>(std::thread::hardware_concurrency(), count) - 1;
  std::vector<std::thread> threads;
  for (int i = 0; i < others; ++i) threads.emplace_back(loop);
  loop();
  for (std::thread& thread : threads) thread.join();
}
