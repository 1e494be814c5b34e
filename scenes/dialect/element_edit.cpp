#include "scenes/dialect/element_edit.h"

#include <algorithm>
#include <utility>

namespace photonproof::scene_xml {
namespace {

auto find_parameter(auto& object, std::string_view name) {
  return std::ranges::find_if(object.children, [&](const Element& child) { return value_of(child, "name") == name; });
}

}  // namespace

std::string value_of(const Element& element, std::string_view attribute) {
  const Attribute* found = element.find(attribute);
  return found ? found->value : std::string();
}

void set_attribute(Element& element, std::string_view attribute, std::string value) {
  for (Attribute& known : element.attributes)
    if (known.name == attribute) {
      known.value = std::move(value);
      return;
    }
  element.attributes.push_back({std::string(attribute), std::move(value), element.at, {}});
}

Element* parameter_of(Element& object, std::string_view name) {
  const auto found = find_parameter(object, name);
  return found == object.children.end() ? nullptr : &*found;
}

const Element* parameter_of(const Element& object, std::string_view name) {
  const auto found = find_parameter(object, name);
  return found == object.children.end() ? nullptr : &*found;
}

Element take_parameter(Element& object, std::string_view name) {
  const auto found = find_parameter(object, name);
  if (found == object.children.end()) return {};
  Element taken = std::move(*found);
  object.children.erase(found);
  return taken;
}

void add_parameter(Element& object, const std::string& tag, const std::string& name, const std::string& value) {
  Element parameter = new_element(object, tag);
  set_attribute(parameter, "name", name);
  set_attribute(parameter, "value", value);
  object.children.push_back(std::move(parameter));
}

void rename_parameter(Element& object, std::string_view name, const std::string& new_name) {
  if (Element* parameter = parameter_of(object, name)) set_attribute(*parameter, "name", new_name);
}

Element new_element(const Element& near, const std::string& tag, const std::string& type) {
  Element element{tag, near.at, {}, {}};
  if (!type.empty()) set_attribute(element, "type", type);
  return element;
}

}  // namespace photonproof::scene_xml
