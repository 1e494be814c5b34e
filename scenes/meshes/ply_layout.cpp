#include "scenes/meshes/ply_layout.h"

#include <algorithm>
#include <initializer_list>

#include "scenes/base/input_error.h"
#include "scenes/base/text_position.h"

namespace photonproof::ply {
namespace {

class Planner {
 public:
  Planner(const Header& header, std::string_view text, const std::string& file)
      : header_(header), text_(text), file_(file) {}

  Layout run() {
    layout_.vertices = find_element("vertex", "it has no surface");
    layout_.faces = find_element("face", "it is a cloud of points and has no surface");
    for (const Element& element : header_.elements) {
      layout_.elements.emplace_back();
      for (const Property& property : element.properties)
        layout_.elements.back().push_back({property.type, property.count_type, kNowhere});
    }
    plan_vertices();
    plan_faces();
    layout_.of_vertices = place_attributes(layout_.vertices, "vertex_");
    layout_.of_faces = place_attributes(layout_.faces, "face_");
    return std::move(layout_);
  }

 private:
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    fail_at_offset(file_, text_, offset, message);
  }

  std::size_t find_element(const std::string& name, const std::string& consequence) const {
    const auto found = std::find_if(header_.elements.begin(), header_.elements.end(),
                                    [&](const Element& element) { return element.name == name; });
    if (found == header_.elements.end())
      throw InputError(file_, "the file has no element '" + name + "': " + consequence);
    if (found->count == 0) fail(found->offset, "element '" + name + "' has no rows: the mesh has no triangles");
    if (found->count > kMaxElements)
      fail(found->offset, "element '" + name + "' has " + std::to_string(found->count) + " rows, the limit is " +
                              std::to_string(kMaxElements));
    return static_cast<std::size_t>(found - header_.elements.begin());
  }

  /// Gives the named properties of a vertex their slots if it has them all.
  bool place(std::initializer_list<const char*> names, int first) {
    const Element& element = header_.elements[layout_.vertices];
    std::vector<std::size_t> found;
    for (const std::string name : names)
      for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name) found.push_back(i);
    if (found.size() != names.size()) return false;
    for (const std::size_t i : found) {
      const Property& property = element.properties[i];
      if (property.count_type)
        fail(property.offset, "property '" + property.name + "' is a list, expected one float or double");
      if (!is_floating(property.type))
        fail(property.offset,
             "property '" + property.name + "' is of type '" + name_of(property.type) + "', expected float or double");
      layout_.elements[layout_.vertices][i].slot = first++;
    }
    return true;
  }

  /// Whether a property may be part of an attribute: a number without a place. Mitsuba converts integers
  /// that are no bytes by a rule of its own.
  bool is_free(std::size_t element, std::size_t i) const {
    const Property& property = header_.elements[element].properties[i];
    return layout_.elements[element][i].slot == kNowhere && !property.count_type &&
           (is_floating(property.type) || property.type == Type::uint8);
  }

  /// The property's index; the number of properties if no free one has that name.
  std::size_t find_free(std::size_t element, const std::string& name) const {
    const std::vector<Property>& properties = header_.elements[element].properties;
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == name && is_free(element, i)) return i;
    return properties.size();
  }

  /// Gives the properties at these indices the next slots, as the attribute `name`, unless another has that name.
  void add_attribute(std::vector<Attribute>& attributes, std::size_t element, const std::string& name,
                     const std::vector<std::size_t>& found) {
    if (std::any_of(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == name; })) return;
    int slot = kAttributes + 3 * static_cast<int>(attributes.size());
    for (const std::size_t i : found) layout_.elements[element][i].slot = slot++;
    attributes.push_back({name, found.size() == 1});
  }

  /// The names are those of Mitsuba 3: r g b or red green blue are `color`. Neighbours whose names end with _x _y _z,
  /// _r _g _b, _0 _1 _2 or _1 _2 _3 have the name before that, with _color after it for _r. One property alone ends
  /// with the first of these.
  std::vector<Attribute> place_attributes(std::size_t element, const std::string& prefix) {
    const std::vector<Property>& properties = header_.elements[element].properties;
    std::vector<Attribute> attributes;
    for (const std::initializer_list<const char*> names :
         {std::initializer_list<const char*>{"r", "g", "b"}, {"red", "green", "blue"}}) {
      std::vector<std::size_t> found;
      for (const char* name : names) found.push_back(find_free(element, name));
      if (std::find(found.begin(), found.end(), properties.size()) == found.end())
        add_attribute(attributes, element, prefix + "color", found);
    }
    for (std::size_t i = 0; i < properties.size();) {
      const std::size_t end = end_of_group(element, i);
      const std::string& first = properties[i].name;
      if (end == i + 1 || end == i + 3) {
        std::vector<std::size_t> found;
        for (std::size_t k = i; k < end; ++k) found.push_back(k);
        add_attribute(attributes, element,
                      prefix + first.substr(0, first.size() - 2) + (first.ends_with("_r") ? "_color" : ""), found);
      }
      i = std::max(end, i + 1);
    }
    return attributes;
  }

  /// One past the last of the neighbours of the group that begins with property i; i if none does.
  std::size_t end_of_group(std::size_t element, std::size_t i) const {
    const std::vector<Property>& properties = header_.elements[element].properties;
    for (const std::string_view ends : {"xyzw", "rgba", "0123", "1234"}) {
      std::size_t end = i;
      const std::string& first = properties[i].name;
      if (first.size() < 2 || first[first.size() - 2] != '_' || first.back() != ends.front()) continue;
      const std::string stem = first.substr(0, first.size() - 1);
      while (end < properties.size() && end - i < ends.size() && properties[end].name == stem + ends[end - i] &&
             is_free(element, end))
        ++end;
      return end;
    }
    return i;
  }

  void plan_vertices() {
    if (!place({"x", "y", "z"}, kX))
      fail(header_.elements[layout_.vertices].offset, "element 'vertex' lacks one of the properties x, y and z");
    layout_.has_normals = place({"nx", "ny", "nz"}, kNx);
    layout_.has_uvs = place({"u", "v"}, kU) || place({"texture_u", "texture_v"}, kU) || place({"s", "t"}, kU);
  }

  void plan_faces() {
    const Element& element = header_.elements[layout_.faces];
    const auto found = std::find_if(element.properties.begin(), element.properties.end(), [](const Property& property) {
      return property.name == "vertex_index" || property.name == "vertex_indices";
    });
    if (found == element.properties.end())
      fail(element.offset, "element 'face' lacks the property vertex_indices (or vertex_index)");
    if (!found->count_type) fail(found->offset, "property '" + found->name + "' is one value, expected a list");
    if (is_floating(found->type))
      fail(found->offset,
           "property '" + found->name + "' is of type '" + name_of(found->type) + "', expected an integer type");
    layout_.elements[layout_.faces][static_cast<std::size_t>(found - element.properties.begin())].slot = kCorners;
  }

  const Header& header_;
  std::string_view text_;
  const std::string& file_;
  Layout layout_;
};

}  // namespace

Layout plan_layout(const Header& header, std::string_view text, const std::string& file) {
  return Planner(header, text, file).run();
}

}  // namespace photonproof::ply
