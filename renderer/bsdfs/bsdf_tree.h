// BSDFs that wrap others, as a table of nodes beside the table of leaves: which leaf a hit gets is decided hit by hit
// (surface_detail.h).
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
    two_sided,  ///< first in front, second behind
    mask,       ///< first where there is a surface; number: how likely that is
    blend,      ///< second as likely as number says, else first
    bump,       ///< number.texture displaces the normal, number.value times
    normal_map  ///< number.texture has the normals
  };
  Kind kind = Kind::leaf;
  std::uint32_t first = 0, second = 0;
  TexturedNumber number{};
  std::vector<TextureSlot> slots{};  ///< of a leaf
  bool has_directions = false;       ///< a leaf that asks for the tangent along dp/du
  bool flips = false;                ///< a map that mirrors its normal to face the viewer
  bool shadows = false;              ///< a map whose bumps shadow each other
};

/// By the description's indices.
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
