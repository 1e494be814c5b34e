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
