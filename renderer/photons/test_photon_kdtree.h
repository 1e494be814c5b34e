// The k nearest photons, for tests and benches (the program gathers discs only). A kd-tree whose leaves are buckets of
// photons as arrays, cut at the median of the widest axis (Friedman, Bentley, Finkel 1977). Nodes store the bounds of
// their photons instead of the cuts: photons lie on surfaces, whose bounds are far smaller than a cut's half space.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/core/large_array.h"
#include "renderer/core/parallel.h"
#include "renderer/photons/photons.h"

namespace photonproof::inline renderer_photons {

class PhotonKdTree {
 public:
  struct Neighbour {
    float distance_squared;
    std::uint32_t index;  ///< into the photons of the tree
    friend auto operator<=>(const Neighbour&, const Neighbour&) = default;
  };

  PhotonKdTree() = default;
  /// Fewer than 2^32 photons.
  PhotonKdTree(const Photons& photons, const Threads& threads);

  std::size_t size() const { return index_.size(); }

  /// The photons that come first by (distance_squared, index), at most out.size() and none with distance_squared >
  /// max_radius^2, in that order; returns their number. The squared distance is evaluated as PhotonView's, so the
  /// result equals brute force's for any tree. Finite p, max_radius >= 0.
  std::size_t nearest(const Vec3f& p, float max_radius, std::span<Neighbour> out) const;

 private:
  struct Box {
    Vec3f low, high;
  };
  struct Item {
    Vec3f p;
    std::uint32_t index = 0;
  };
  /// Photons of node k of the 2^level on a level.
  std::size_t begin_of(int level, std::size_t k) const { return (size() * k) >> level; }
  void cut(std::vector<Item>& items, int level, std::size_t k);
  void cut_subtree(std::vector<Item>& items, int level, std::size_t k);
  float distance_squared(std::size_t node, const Vec3f& p) const;

  int leaf_level_ = 0;
  std::vector<Box> boxes_;       ///< node k of a level is 2^level + k; the children of n are 2n and 2n + 1
  LargeArray<float> x_, y_, z_;  ///< leaf after leaf, and Photons::padding more
  LargeArray<std::uint32_t> index_;
};

}  // namespace photonproof::inline renderer_photons
