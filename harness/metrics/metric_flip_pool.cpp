#include <algorithm>
#include <atomic>
#include <new>

#include "harness/metrics/metric_flip.h"

namespace photonproof::inline harness_metrics {
namespace {

constexpr std::size_t kSteps = std::size_t{flip_steps} + 1;
constexpr std::size_t kGroup = 2048;

}  // namespace

FlipPool::FlipPool(std::uint64_t pixels) {
  if (pixels <= most_listed) {
    listed_.resize(static_cast<std::size_t>(pixels));
    return;
  }
  counts_.reset(static_cast<std::uint32_t*>(std::calloc(kSteps, sizeof(std::uint32_t))));
  if (!counts_) throw std::bad_alloc();
  group_used_.resize(kSteps / kGroup + 1);
}

void FlipPool::add(const PairTile& tile, const std::uint32_t* steps) {
  if (counts_)
    count(tile, steps);
  else
    list(tile, steps);
}

void FlipPool::list(const PairTile& tile, const std::uint32_t* steps) {
  for (int y = 0; y < tile.height(); ++y)
    for (int x = 0; x < tile.width(); ++x, ++steps)
      if (tile.counts(x, y)) listed_.at(std::atomic_ref(added_).fetch_add(1, std::memory_order_relaxed)) = *steps;
}

void FlipPool::count(const PairTile& tile, const std::uint32_t* steps) {
  std::uint32_t zeros = 0;
  const auto count = [&](std::uint32_t step) {
    if (step == 0) {
      ++zeros;
      return;
    }
    std::atomic_ref(counts_[step]).fetch_add(1, std::memory_order_relaxed);
    std::atomic_ref(group_used_[step / kGroup]).store(1, std::memory_order_relaxed);
  };
  for (int y = 0; y < tile.height(); ++y)
    for (int x = 0; x < tile.width(); ++x, ++steps)
      if (tile.counts(x, y)) count(*steps);
  std::atomic_ref(counts_[0]).fetch_add(zeros, std::memory_order_relaxed);
  std::atomic_ref(group_used_[0]).store(1, std::memory_order_relaxed);
}

template <class Visit>
void FlipPool::ascending_list(const Visit& visit) const {
  const auto end = listed_.begin() + static_cast<std::ptrdiff_t>(added_);
  if (!sorted_) std::sort(listed_.begin(), end);
  sorted_ = true;
  for (auto first = listed_.begin(); first != end;) {
    const auto next = std::find_if(first, end, [step = *first](std::uint32_t other) { return other != step; });
    if (visit(std::size_t{*first}, static_cast<std::uint64_t>(next - first))) return;
    first = next;
  }
}

/// visit(step, count) of every error that occurs, smallest first, until it returns true.
template <class Visit>
void FlipPool::ascending(const Visit& visit) const {
  if (!counts_) return ascending_list(visit);
  for (std::size_t group = 0; group < group_used_.size(); ++group) {
    if (!group_used_[group]) continue;
    for (std::size_t step = group * kGroup; step < std::min(kSteps, (group + 1) * kGroup); ++step)
      if (counts_[step] > 0 && visit(step, std::uint64_t{counts_[step]})) return;
  }
}

double FlipPool::mean() const {
  std::uint64_t sum = 0, pixels = 0;
  ascending([&](std::size_t step, std::uint64_t count) {
    sum += step * count;
    pixels += count;
    return false;
  });
  return static_cast<double>(sum) / flip_steps / static_cast<double>(pixels);
}

double FlipPool::weighted_percentile(double fraction) const {
  std::uint64_t sum = 0;
  ascending([&](std::size_t step, std::uint64_t count) {
    sum += step * count;
    return false;
  });
  std::uint64_t running = 0;
  std::size_t found = 0;
  ascending([&](std::size_t step, std::uint64_t count) {
    running += step * count;
    if (static_cast<double>(running) <= fraction * static_cast<double>(sum)) return false;
    found = step;
    return true;
  });
  return static_cast<double>(found) / flip_steps;
}

double FlipPool::greatest() const {
  std::size_t greatest = 0;
  ascending([&](std::size_t step, std::uint64_t) {
    greatest = step;
    return false;
  });
  return static_cast<double>(greatest) / flip_steps;
}

}  // namespace photonproof::inline harness_metrics
