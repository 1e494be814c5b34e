#include "renderer/scene/mesh_attributes.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "scenes/base/text_numbers.h"

namespace photonproof::inline renderer_scene {
namespace {

constexpr float most_shown = 1 + 1e-6f;  ///< 255 times 1/255, rounded

struct Shown {
  std::set<std::uint32_t> values;   ///< textures whose values count
  std::set<std::uint32_t> heights;  ///< textures whose slopes count
};

/// The textures of a BSDF and of those that it wraps.
Shown textures_of(const BsdfTable& bsdfs, std::uint32_t bsdf) {
  Shown found;
  std::vector<std::uint32_t> open = {bsdf};
  while (!open.empty()) {
    const BsdfNode& node = bsdfs.tree[open.back()];
    open.pop_back();
    for (const TextureSlot& slot : node.slots) found.values.insert(slot.texture);
    if (node.kind == BsdfNode::Kind::leaf) continue;
    if (node.number.texture != no_index)
      (node.kind == BsdfNode::Kind::bump ? found.heights : found.values).insert(node.number.texture);
    open.push_back(node.first);
    if (node.kind == BsdfNode::Kind::two_sided || node.kind == BsdfNode::Kind::blend) open.push_back(node.second);
  }
  return found;
}

std::string names_of(const std::vector<MeshAttribute>& attributes) {
  if (attributes.empty()) return "it has none";
  std::string names;
  for (const MeshAttribute& attribute : attributes) names += (names.empty() ? "it has " : ", ") + attribute.name;
  return names;
}

/// The shape whose file a surface's mesh is from: for a copy, that of its group.
const ShapeDescription& owner(const SceneDescription& description, const Surface& surface,
                              const ShapeDescription& shape) {
  const auto* copy = std::get_if<MeshInstance>(&surface.geometry);
  return copy != nullptr ? description.groups[copy->group].shapes[copy->part] : shape;
}

void check(const MeshAttributeDescription& wanted, const Rgb& factor, const ShapeDescription& shape,
           const std::string& where) {
  const auto* file = std::get_if<MeshDescription>(&shape.geometry);
  if (file == nullptr)
    throw InputError(where, "the shape has no attribute '" + wanted.name + "', which only the mesh of a file can have");
  const std::vector<MeshAttribute>& given = file->mesh->attributes;
  const auto found = std::ranges::find(given, wanted.name, &MeshAttribute::name);
  if (found == given.end())
    throw InputError(where, "mesh '" + file->filename + "' has no attribute '" + wanted.name + "': " + names_of(given));
  for (const Rgb& value : found->values) {
    const Rgb shown = value * factor;
    for (const float c : {shown.x, shown.y, shown.z})
      if (!(c >= 0 && c <= most_shown))
        throw InputError(where, "attribute '" + wanted.name + "' of mesh '" + file->filename + "' has the value " +
                                    format_number(c) + ", expected from 0 to 1" +
                                    (c > 1 ? "; a scale of 0.00392 makes shares of bytes" : ""));
  }
}

}  // namespace

void check_mesh_attributes(const SceneDescription& description, const Textures& textures, const BsdfTable& bsdfs,
                           const std::vector<Surface>& surfaces, const std::vector<const ShapeDescription*>& shape_of) {
  if (!textures.need_place()) return;
  std::set<std::pair<const ShapeDescription*, std::uint32_t>> known;  // many instances share a mesh and a texture
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const ShapeDescription& shape = owner(description, surfaces[i], *shape_of[i]);
    const std::string where = description.where(shape.loc);
    const auto refuse = [&](std::uint32_t texture, const std::string& use) {
      if (textures.shows_volume(texture)) throw InputError(where, "a volume cannot be " + use);
      textures.visit_attributes(texture, [&](const MeshAttributeDescription& attribute, const Rgb&) {
        throw InputError(where, "the mesh attribute '" + attribute.name + "' cannot be " + use);
      });
    };
    if (const auto* field = std::get_if<HeightfieldDescription>(&shape.geometry))
      if (const auto* height = std::get_if<TextureIndex>(&field->height)) refuse(height->value, "a heightfield");
    const Shown shown = textures_of(bsdfs, surfaces[i].bsdf);
    for (const std::uint32_t texture : shown.heights) refuse(texture, "a bump map");
    for (const std::uint32_t texture : shown.values)
      if (known.insert({&shape, texture}).second)
        textures.visit_attributes(texture, [&](const MeshAttributeDescription& attribute, const Rgb& factor) {
          check(attribute, factor, shape, where);
        });
  }
}

}  // namespace photonproof::inline renderer_scene
