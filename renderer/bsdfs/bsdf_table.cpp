#include "renderer/bsdfs/bsdf_table.h"

#include <algorithm>

#include "renderer/bsdfs/compile_bsdf.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

void refuse_deep_maps(const SceneDescription& description, const std::vector<BsdfNode>& tree) {
  std::vector<int> maps(tree.size(), 0);  // maximum on the way to the deepest leaf; nested BSDFs come first
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const BsdfNode& node = tree[i];
    if (node.kind == BsdfNode::Kind::leaf) continue;
    const bool is_map = node.kind == BsdfNode::Kind::bump || node.kind == BsdfNode::Kind::normal_map;
    maps[i] = std::max(maps[node.first], maps[node.second]) + (is_map ? 1 : 0);
    if (maps[i] > 2)
      throw InputError(description.where(description.bsdfs[i].loc),
                       "more than two bump or normal maps nest, one over the other");
  }
}

}  // namespace

BsdfTable compile_bsdfs(const SceneDescription& description) {
  BsdfTable table;
  table.tree = bsdf_tree(description.bsdfs);
  bool has_holes = false;
  for (std::uint32_t i = 0; i < description.bsdfs.size(); ++i) {
    BsdfNode& node = table.tree[i];
    has_holes = has_holes || node.kind == BsdfNode::Kind::mask;
    if (node.kind != BsdfNode::Kind::leaf) {
      table.records.emplace_back();  // never read
      continue;
    }
    CompiledBsdf compiled = compile_bsdf(description, {i});
    table.records.push_back(compiled.record);
    node.slots = std::move(compiled.slots);
    node.has_directions = is_anisotropic(description, {i});
  }
  refuse_deep_maps(description, table.tree);
  table.nothing = static_cast<std::uint32_t>(table.records.size());
  if (has_holes) {
    table.records.emplace_back(NullBsdf<float>{});
    table.tree.emplace_back();
  }
  return table;
}

}  // namespace photonproof::inline renderer_bsdfs
