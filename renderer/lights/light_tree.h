// Chooses one of many lights by the light that arrives at a point, with a binary tree over the finite lights. The
// descent compares the importance of both children. Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many
// Lights with Adaptive Tree Splitting", without the splitting. The receiver's normal is not used.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/lights/light.h"
#include "renderer/lights/light_bounds.h"

namespace photonproof::inline renderer_lights {

class LightTree {
 public:
  /// Builds the tree over the finite lights with flux, at least one.
  explicit LightTree(const std::vector<Light>& lights);
  /// Builds the tree over any bounds, at least one of which has power.
  explicit LightTree(const std::vector<std::optional<LightBounds>>& lights);

  struct Choice {
    std::uint32_t light;
    float probability;
    float u;  ///< rest of the uniform number, uniform again
  };
  /// Empty where no light can arrive.
  std::optional<Choice> choose(const Vec3f& p, float u) const;
  /// Probability that `choose` gives this light; 0 for one that is not in the tree.
  float probability(const Vec3f& p, std::uint32_t light) const;

 private:
  struct Node {
    LightImportance importance;
    std::uint32_t parent = 0;
    std::uint32_t left = 0, right = 0;  ///< children; equal in a leaf
    std::uint32_t light = 0;            ///< light of a leaf
    bool is_leaf() const { return left == right; }
  };
  struct Entry {
    LightBounds bounds;
    std::uint32_t light;
  };
  std::uint32_t build(Entry* first, Entry* last, std::uint32_t parent);
  /// Probability of going left from a node; empty where no light arrives from either side.
  std::optional<float> left_probability(const Node& node, const Vec3f& p) const;

  std::vector<Node> nodes_;             ///< root first
  std::vector<std::uint32_t> leaf_of_;  ///< by light; no_index where it is not in the tree
};

}  // namespace photonproof::inline renderer_lights
