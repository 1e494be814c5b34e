#include "scenes/dialect/attribute_stand_ins.h"

#include <algorithm>
#include <map>
#include <string>

#include "scenes/dialect/element_edit.h"

namespace photonproof::scene_xml {
namespace {

using Textures = std::map<std::string, Element>;

bool is_attribute(const Element& child) {
  const std::string name = value_of(child, "name");
  return child.tag == "texture" && (name.starts_with("vertex_") || name.starts_with("face_"));
}

Textures take_attributes(Element& shape) {
  Textures found;
  for (const Element& child : shape.children)
    if (is_attribute(child)) found.emplace(value_of(child, "name"), child);
  std::erase_if(shape.children, is_attribute);
  return found;
}

/// The texture that a mesh attribute shows, or null.
const Element* shown_by(const Element& element, const Textures& textures) {
  if (element.tag != "texture" || value_of(element, "type") != "mesh_attribute") return nullptr;
  const Element* name = parameter_of(element, "name");
  const auto found = name != nullptr ? textures.find(value_of(*name, "value")) : textures.end();
  return found != textures.end() ? &found->second : nullptr;
}

bool shows_any(const Element& element, const Textures& textures) {
  return shown_by(element, textures) != nullptr ||
         std::ranges::any_of(element.children, [&](const Element& child) { return shows_any(child, textures); });
}

void name_as(Element& texture, const std::string& name) {
  std::erase_if(texture.attributes, [](const Attribute& a) { return a.name == "name"; });
  if (!name.empty()) set_attribute(texture, "name", name);
}

/// `attribute` becomes the texture, times its own scale.
void replace(Element& attribute, Element texture) {
  const std::string name = value_of(attribute, "name");
  Element scale = take_parameter(attribute, "scale");
  if (!scale.tag.empty()) {
    name_as(texture, "");
    Element scaled = new_element(attribute, "texture", "scale");
    scaled.children = {std::move(texture), std::move(scale)};
    texture = std::move(scaled);
  }
  name_as(texture, name);
  attribute = std::move(texture);
}

void replace_within(Element& element, const Textures& textures) {
  if (const Element* texture = shown_by(element, textures)) return replace(element, *texture);
  for (Element& child : element.children) replace_within(child, textures);
}

void without_ids(Element& element) {
  std::erase_if(element.attributes, [](const Attribute& a) { return a.name == "id"; });
  for (Element& child : element.children)
    if (child.tag != "ref") without_ids(child);
}

void replace_in_shape(Element& shape, const std::map<std::string, Element>& bsdfs) {
  const Textures textures = take_attributes(shape);
  if (textures.empty()) return;
  for (Element& child : shape.children) {
    const auto shared = child.tag == "ref" ? bsdfs.find(value_of(child, "id")) : bsdfs.end();
    if (shared != bsdfs.end() && shows_any(shared->second, textures)) {
      child = shared->second;
      without_ids(child);
    }
    if (child.tag == "bsdf") replace_within(child, textures);
  }
}

void replace_in_shapes(Element& parent, const std::map<std::string, Element>& bsdfs) {
  for (Element& child : parent.children) {
    if (child.tag != "shape") continue;
    replace_in_shape(child, bsdfs);
    replace_in_shapes(child, bsdfs);
  }
}

bool any_attribute(const Element& parent) {
  return std::ranges::any_of(parent.children, [](const Element& child) {
    return child.tag == "shape" && (std::ranges::any_of(child.children, is_attribute) || any_attribute(child));
  });
}

}  // namespace

void put_textures_in_place_of_attributes(Element& scene) {
  if (!any_attribute(scene)) return;
  std::map<std::string, Element> bsdfs;
  for (const Element& child : scene.children)
    if (child.tag == "bsdf" && child.find("id")) bsdfs.emplace(value_of(child, "id"), child);
  replace_in_shapes(scene, bsdfs);
}

}  // namespace photonproof::scene_xml
