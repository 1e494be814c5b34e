#include "renderer/photons/test_photon_kdtree.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace photonproof::inline renderer_photons {
namespace {

constexpr std::size_t most_in_leaf = 32;  // 16 is slower, 64 no faster
constexpr int shared_levels = 5;          // cut level by level, their nodes in parallel; below, subtrees are
constexpr std::size_t block = 16;
static_assert(block <= Photons::padding);

/// The best candidates so far as numbers that order as (distance_squared, index): floats that are not negative compare
/// as their bits. Kept in a buffer that is cut back to the best k whenever it is full, which costs less a candidate
/// than a heap.
class Candidates {
 public:
  /// `small` is memory to use while it suffices.
  Candidates(std::size_t wanted, float max_distance_squared, std::span<std::int64_t> small)
      : wanted_(wanted), limit_(key(max_distance_squared, 0xFFFFFFFF)) {
    const std::size_t capacity = wanted + std::max<std::size_t>(wanted, 32) + block;
    if (2 * capacity > small.size()) large_.resize(2 * capacity);
    std::int64_t* memory = large_.empty() ? small.data() : large_.data();
    keys_ = {memory, capacity};
    spare_ = {memory + capacity, capacity};
  }

  /// A candidate that is farther is of no use.
  float bound() const { return std::bit_cast<float>(static_cast<std::uint32_t>(limit_ >> 32)); }

  void make_room_for_a_block() {
    if (count_ + block > keys_.size()) keep_the_best();
  }
  void add(float distance_squared, std::uint32_t index) {
    const std::int64_t candidate = key(distance_squared, index);
    keys_[count_] = candidate;
    count_ += candidate <= limit_ ? 1 : 0;
  }

  /// In order; returns how many.
  std::size_t store(std::span<PhotonKdTree::Neighbour> out) {
    if (count_ > wanted_) keep_the_best();
    const auto put = [&](std::size_t rank, std::int64_t k) {
      out[rank] = {std::bit_cast<float>(static_cast<std::uint32_t>(k >> 32)), static_cast<std::uint32_t>(k)};
    };
    if (count_ <= 64) {  // a key's rank is the number of those below: quadratic, but without a branch to mispredict
      for (std::size_t i = 0; i < count_; ++i) {
        std::int64_t rank = 0;
        for (std::size_t j = 0; j < count_; ++j) rank += keys_[j] < keys_[i] ? 1 : 0;
        put(static_cast<std::size_t>(rank), keys_[i]);
      }
    } else {
      std::sort(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(count_));
      for (std::size_t i = 0; i < count_; ++i) put(i, keys_[i]);
    }
    return count_;
  }

 private:
  static std::int64_t key(float distance_squared, std::uint32_t index) {
    return static_cast<std::int64_t>(std::uint64_t{std::bit_cast<std::uint32_t>(distance_squared)} << 32 | index);
  }
  void keep_the_best() {
    // Quickselect (Hoare 1961) whose partition has no branches: with so few keys, std::nth_element took half of the
    // time of a gather, most of it mispredicted branches. Keys are distinct, so of three or more some are below the
    // median of three and some are not.
    std::size_t begin = 0, end = count_;  // of the part the wanted-th key is in
    while (end - begin > 2) {
      const std::int64_t a = keys_[begin], b = keys_[begin + (end - begin) / 2], c = keys_[end - 1];
      const std::int64_t pivot = std::max(std::min(a, b), std::min(std::max(a, b), c));
      std::size_t below = begin, not_below = 0;
      for (std::size_t i = begin; i < end; ++i) {
        const std::int64_t k = keys_[i];
        keys_[below] = k;
        spare_[not_below] = k;
        below += k < pivot ? 1 : 0;
        not_below += k < pivot ? 0 : 1;
      }
      std::copy_n(spare_.begin(), not_below, keys_.begin() + static_cast<std::ptrdiff_t>(below));
      (below >= wanted_ ? end : begin) = below;
    }
    if (keys_[end - 1] < keys_[begin]) std::swap(keys_[begin], keys_[end - 1]);
    limit_ = keys_[wanted_ - 1];
    count_ = wanted_;
  }

  std::size_t wanted_;
  std::int64_t limit_;
  std::size_t count_ = 0;
  std::vector<std::int64_t> large_;
  std::span<std::int64_t> keys_, spare_;
};

float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

PhotonKdTree::PhotonKdTree(const Photons& photons, const Threads& threads) {
  if (photons.empty()) return;
  index_.resize(photons.size());
  while ((size() >> leaf_level_) >= most_in_leaf) ++leaf_level_;
  boxes_.resize(std::size_t{2} << leaf_level_);
  std::vector<Item> items(size());
  for (std::size_t i = 0; i < size(); ++i)
    items[i] = {{photons.x[i], photons.y[i], photons.z[i]}, static_cast<std::uint32_t>(i)};

  const int roots_level = std::min(shared_levels, leaf_level_);
  for (int level = 0; level < roots_level; ++level)
    threads.for_each(std::size_t{1} << level, [&](std::size_t k) { cut(items, level, k); });
  threads.for_each(std::size_t{1} << roots_level, [&](std::size_t k) { cut_subtree(items, roots_level, k); });

  for (auto* coordinate : {&x_, &y_, &z_}) coordinate->assign(size() + Photons::padding, 0.0f);
  for (std::size_t i = 0; i < size(); ++i) {
    x_[i] = items[i].p.x;
    y_[i] = items[i].p.y;
    z_[i] = items[i].p.z;
    index_[i] = items[i].index;
  }
}

/// Finds the node's bounds and, above the leaves, moves the lower half along their widest axis to the front.
void PhotonKdTree::cut(std::vector<Item>& items, int level, std::size_t k) {
  const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t begin = begin_of(level, k), end = begin_of(level, k + 1);
  Box box{items[begin].p, items[begin].p};
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3f& p = items[i].p;
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  boxes_[(std::size_t{1} << level) + k] = box;
  if (level == leaf_level_) return;
  const Vec3f extent = box.high - box.low;
  const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  std::nth_element(at(begin), at(begin_of(level + 1, 2 * k + 1)), at(end),
                   [axis](const Item& a, const Item& b) { return component(a.p, axis) < component(b.p, axis); });
}

void PhotonKdTree::cut_subtree(std::vector<Item>& items, int level, std::size_t k) {
  cut(items, level, k);
  if (level == leaf_level_) return;
  cut_subtree(items, level + 1, 2 * k);
  cut_subtree(items, level + 1, 2 * k + 1);
}

/// From p to the node's bounds. Not above the squared distance of any photon in them as that is rounded: subtraction,
/// multiplication and addition are monotone, and the order of the operations is the same.
float PhotonKdTree::distance_squared(std::size_t node, const Vec3f& p) const {
  const Box& box = boxes_[node];
  const auto along = [](float at, float low, float high) { return std::max({low - at, at - high, 0.0f}); };
  const float dx = along(p.x, box.low.x, box.high.x);
  const float dy = along(p.y, box.low.y, box.high.y);
  const float dz = along(p.z, box.low.z, box.high.z);
  return dx * dx + dy * dy + dz * dz;
}

std::size_t PhotonKdTree::nearest(const Vec3f& p, float max_radius, std::span<Neighbour> out) const {
  if (index_.empty() || out.empty()) return 0;
  std::int64_t memory[512];
  Candidates candidates(out.size(), max_radius * max_radius, memory);
  const auto scan_leaf = [&](std::size_t leaf) {
    const std::size_t end = begin_of(leaf_level_, leaf + 1);
    for (std::size_t i = begin_of(leaf_level_, leaf); i < end; i += block) {
      float distances[block];
      for (std::size_t k = 0; k < block; ++k) {
        const float dx = x_[i + k] - p.x, dy = y_[i + k] - p.y, dz = z_[i + k] - p.z;
        distances[k] = dx * dx + dy * dy + dz * dz;
      }
      candidates.make_room_for_a_block();
      for (std::size_t k = 0; k < std::min(block, end - i); ++k) candidates.add(distances[k], index_[i + k]);
    }
  };
  struct Entry {
    float distance_squared;
    std::size_t node;
  };
  Entry farther[64];  // one a level at most
  std::size_t waiting = 0;
  const std::size_t first_leaf = std::size_t{1} << leaf_level_;
  for (Entry next{distance_squared(1, p), 1};; next = farther[--waiting]) {
    if (next.distance_squared <= candidates.bound()) {
      while (next.node < first_leaf) {
        Entry near{distance_squared(2 * next.node, p), 2 * next.node};
        Entry far{distance_squared(2 * next.node + 1, p), 2 * next.node + 1};
        if (far.distance_squared < near.distance_squared) std::swap(near, far);
        if (far.distance_squared <= candidates.bound()) farther[waiting++] = far;
        next = near;
      }
      scan_leaf(next.node - first_leaf);
    }
    if (waiting == 0) break;
  }
  return candidates.store(out);
}

}  // namespace photonproof::inline renderer_photons
