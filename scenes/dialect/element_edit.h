// Edits of the tree of a scene file. What an edit adds has the place of what it replaces.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// The value of an attribute, empty without it.
std::string value_of(const Element& element, std::string_view attribute);
/// Sets or adds an attribute.
void set_attribute(Element& element, std::string_view attribute, std::string value);

/// The child whose attribute `name` is that, or null.
Element* parameter_of(Element& object, std::string_view name);
const Element* parameter_of(const Element& object, std::string_view name);
/// Removes the child of that name and returns it; without one the result has no tag.
Element take_parameter(Element& object, std::string_view name);
/// Adds <tag name="name" value="value"/>.
void add_parameter(Element& object, const std::string& tag, const std::string& name, const std::string& value);
/// Does nothing where the parameter is not given.
void rename_parameter(Element& object, std::string_view name, const std::string& new_name);

/// A new element at the place of `near`, with an attribute `type` unless that is empty.
Element new_element(const Element& near, const std::string& tag, const std::string& type = {});

}  // namespace photonproof::scene_xml
