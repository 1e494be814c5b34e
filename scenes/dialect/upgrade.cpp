#include "scenes/dialect/upgrade.h"

#include <cctype>

#include "scenes/dialect/element_edit.h"
#include "scenes/dialect/sky_stand_ins.h"

namespace photonproof::scene_xml {
namespace {

bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// "toWorld" to "to_world", "intIOR" to "int_ior".
std::string snake_case(const std::string& name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (i == 0 || !is_lower(name[i - 1]) || !is_upper(name[i])) {
      result += name[i];
      continue;
    }
    result += '_';
    for (; i < name.size() && is_upper(name[i]); ++i)
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    --i;
  }
  return result;
}

/// Takes two numbers of a texture as the x and y of a transform's `operation`.
void move_into(Element& texture, const char* name_x, const char* name_y, const char* operation, Element& transform) {
  const Element x = take_parameter(texture, name_x), y = take_parameter(texture, name_y);
  if (x.tag.empty() && y.tag.empty()) return;
  Element step = new_element(x.tag.empty() ? y : x, operation);
  if (!x.tag.empty()) set_attribute(step, "x", value_of(x, "value"));
  if (!y.tag.empty()) set_attribute(step, "y", value_of(y, "value"));
  transform.children.push_back(std::move(step));
}

void upgrade_uv(Element& texture) {
  Element transform = new_element(texture, "transform");
  set_attribute(transform, "name", "to_uv");
  move_into(texture, "uscale", "vscale", "scale", transform);
  move_into(texture, "uoffset", "voffset", "translate", transform);
  if (!transform.children.empty()) texture.children.push_back(std::move(transform));
}

}  // namespace

void upgrade_names(Element& root) {
  if (root.tag == "lookAt") root.tag = "lookat";
  if (root.tag == "luminaire") root.tag = "emitter";
  if (root.tag == "camera") root.tag = "sensor";
  if (root.tag != "default")
    for (Attribute& attribute : root.attributes)
      if (attribute.name == "name") attribute.value = snake_case(attribute.value);
  for (Element& child : root.children) upgrade_names(child);
  if (root.tag == "bsdf" && value_of(root, "type") == "diffuse")
    rename_parameter(root, "diffuse_reflectance", "reflectance");
  if (root.tag == "texture") upgrade_uv(root);
  if (root.tag == "emitter" && value_of(root, "type") == "sunsky") set_attribute(root, "type", sunsky_of_old);
}

}  // namespace photonproof::scene_xml
