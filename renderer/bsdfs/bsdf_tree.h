// BSDFs that wrap others, as a table of nodes beside the table of leaves. surface_detail.h picks the leaf for each hit.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/ray.h"
#include "renderer/textures/texture_slot.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_bsdfs {

/// A number, or the texture that gives it.
struct TexturedNumber {
  float value = 0;
  std::uint32_t texture = no_index;
};

struct BsdfNode {
  enum class Kind : std::uint32_t {
    leaf,
    two_sided,  ///< First in front, second behind.
    mask,       ///< First where there is a surface; number is the probability of that.
    blend,      ///< Second with probability number, otherwise first.
    bump,       ///< Normal displaced by number.texture times number.value.
    normal_map  ///< Normals given by number.texture.
  };
  Kind kind = Kind::leaf;
  std::uint32_t first = 0, second = 0;
  TexturedNumber number{};
  std::vector<TextureSlot> slots{};  ///< texture slots of a leaf
  bool has_directions = false;       ///< a leaf that needs the tangent along dp/du
  bool flips = false;                ///< a map that mirrors its normal to face the viewer
  bool shadows = false;              ///< a map whose bumps shadow each other
  bool mixes_mirrors = false;        ///< a blend: BlendDescription::mixes_mirrors
};

/// The nodes in the order of the description's indices.
std::vector<BsdfNode> bsdf_tree(const std::vector<BsdfDescription>& bsdfs);

/// Calls visit(leaf) for every leaf that a hit on `bsdf` may get, `nothing` (the leaf where a mask has holes) included.
template <class Visit>
void for_each_leaf(const std::vector<BsdfNode>& tree, std::uint32_t bsdf, std::uint32_t nothing, Visit&& visit) {
  const BsdfNode& node = tree[bsdf];
  if (node.kind == BsdfNode::Kind::leaf) {
    visit(bsdf);
    return;
  }
  if (node.kind == BsdfNode::Kind::mask) visit(nothing);
  for_each_leaf(tree, node.first, nothing, visit);
  if (node.second != node.first) for_each_leaf(tree, node.second, nothing, visit);
}

}  // namespace photonproof::inline renderer_bsdfs
