// All BSDFs of a scene: the records of the leaves, and the tree of BSDFs that wrap others.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/bsdfs/bsdf_tree.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_bsdfs {

struct BsdfTable {
  std::vector<Bsdf> records;   ///< by the description's indices; entries of BSDFs that wrap others are unused
  std::vector<BsdfNode> tree;  ///< by the description's indices
  std::uint32_t nothing = 0;   ///< the leaf that stands for a mask's holes

  /// Calls visit(const Bsdf&, bool textured) for every leaf that a hit on a surface with this BSDF may get.
  template <class Visit>
  void for_each_leaf(std::uint32_t bsdf, Visit&& visit) const {
    photonproof::for_each_leaf(tree, bsdf, nothing,
                               [&](std::uint32_t leaf) { visit(records[leaf], !tree[leaf].slots.empty()); });
  }
  /// Kind of a leaf, as its index in BsdfKinds.
  std::uint32_t kind(std::uint32_t leaf) const { return static_cast<std::uint32_t>(records[leaf].index()); }
  /// Whether the BSDF wraps no other.
  bool is_leaf(std::uint32_t bsdf) const { return tree[bsdf].kind == BsdfNode::Kind::leaf; }
  /// Whether test(const Bsdf&, bool textured) is true for some leaf.
  template <class Test>
  bool any_leaf(std::uint32_t bsdf, Test&& test) const {
    bool any = false;
    for_each_leaf(bsdf, [&](const Bsdf& leaf, bool textured) { any = any || test(leaf, textured); });
    return any;
  }
  bool any_lambertian(std::uint32_t bsdf) const {
    return any_leaf(bsdf, [](const Bsdf& leaf, bool) { return is_lambertian(leaf); });
  }
  /// Whether some leaf is not Lambertian.
  bool is_specular(std::uint32_t bsdf) const {
    return any_leaf(bsdf, [](const Bsdf& leaf, bool) { return !is_lambertian(leaf); });
  }
};

/// Throws InputError at a BSDF that cannot be represented.
BsdfTable compile_bsdfs(const SceneDescription& description);

}  // namespace photonproof::inline renderer_bsdfs
