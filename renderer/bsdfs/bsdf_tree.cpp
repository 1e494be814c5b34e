#include "renderer/bsdfs/bsdf_tree.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

using Kind = BsdfNode::Kind;

TexturedNumber textured(const Scalar& scalar) {
  if (const auto* texture = std::get_if<TextureIndex>(&scalar)) return {0, texture->value};
  return {static_cast<float>(std::get<double>(scalar)), no_index};
}

BsdfNode wrapper(Kind kind, BsdfIndex first, BsdfIndex second, const TexturedNumber& number) {
  return {.kind = kind, .first = first.value, .second = second.value, .number = number};
}

BsdfNode map(Kind kind, BsdfIndex nested, const TexturedNumber& number, const MappedNormalsDescription& options) {
  return {.kind = kind,
          .first = nested.value,
          .second = nested.value,
          .number = number,
          .flips = options.flip_invalid_normals,
          .shadows = options.use_shadowing_function};
}

BsdfNode node(const TwoSidedDescription& d) { return wrapper(Kind::two_sided, d.front, d.back, {}); }
BsdfNode node(const MaskDescription& d) { return wrapper(Kind::mask, d.nested, d.nested, textured(d.opacity)); }
BsdfNode node(const BlendDescription& d) {
  BsdfNode blend = wrapper(Kind::blend, d.first, d.second, textured(d.weight));
  blend.mixes_mirrors = d.mixes_mirrors;
  return blend;
}
BsdfNode node(const BumpMapDescription& d) {
  return map(Kind::bump, d.nested, {static_cast<float>(d.scale), d.height.value}, d.normal_options);
}
BsdfNode node(const NormalMapDescription& d) {
  return map(Kind::normal_map, d.nested, {1, d.normals.value}, d.normal_options);
}
BsdfNode node(const LeafBsdf auto&) { return {}; }

}  // namespace

std::vector<BsdfNode> bsdf_tree(const std::vector<BsdfDescription>& bsdfs) {
  std::vector<BsdfNode> tree;
  tree.reserve(bsdfs.size());
  for (const BsdfDescription& b : bsdfs)
    tree.push_back(std::visit([](const auto& model) { return node(model); }, b.model));
  return tree;
}

}  // namespace photonproof::inline renderer_bsdfs
