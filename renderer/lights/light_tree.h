// Chooses one of many lights by what arrives at a point: a binary tree over the finite lights, descended with the
// importance of both children (Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting", without the splitting). The receiver's normal is not used.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/lights/light.h"
#include "renderer/lights/light_bounds.h"

namespace photonproof::inline renderer_lights {

class LightTree {
 public:
  /// Over the finite lights that shine, at least one.
  explicit LightTree(const std::vector<Light>& lights);
  /// Over anything with bounds, at least one of which shines.
  explicit LightTree(const std::vector<std::optional<LightBounds>>& lights);

  struct Choice {
    std::uint32_t light;
    float probability;
    float u;  ///< what is left of the uniform number, uniform again
  };
  /// Nothing where no light can arrive.
  std::optional<Choice> choose(const Vec3f& p, float u) const;
  /// Of `choose` giving this light; 0 for one that is not in the tree.
  float probability(const Vec3f& p, std::uint32_t light) const;

 private:
  struct Node {
    LightImportance importance;
    std::uint32_t parent = 0;
    std::uint32_t left = 0, right = 0;  ///< equal in a leaf
    std::uint32_t light = 0;            ///< of a leaf
    bool is_leaf() const { return left == right; }
  };
  struct Entry {
    LightBounds bounds;
    std::uint32_t light;
  };
  std::uint32_t build(Entry* first, Entry* last, std::uint32_t parent);
  /// Probability of going left from a node; nothing where no light arrives from either side.
  std::optional<float> left_probability(const Node& node, const Vec3f& p) const;

  std::vector<Node> nodes_;             ///< the root first
  std::vector<std::uint32_t> leaf_of_;  ///< by light; no_index where it is not in the tree
};

}  // namespace photonproof::inline renderer_lights
