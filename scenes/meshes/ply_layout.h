// The properties of a PLY file that make up a mesh, and their places in it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/meshes/ply_header.h"

namespace photonproof::ply {

constexpr std::uint64_t kMaxElements = std::uint64_t{1} << 28;  ///< vertices or triangles

/// Destination of a property: a place among the values of a vertex, the corners of a face, or nowhere.
/// The values of attributes have the slots from kAttributes on, three each.
enum Slot : int { kNowhere = -1, kX, kY, kZ, kNx, kNy, kNz, kU, kV, kVertexSlots, kCorners, kAttributes };

/// Reads one property of a row.
struct Step {
  Type type = Type::float32;
  std::optional<Type> count_type{};  ///< of a list
  int slot = kNowhere;
};

/// A group of properties of one vertex or face.
struct Attribute {
  std::string name;   ///< with its vertex_ or face_
  bool grey = false;  ///< one value in place of three
};

struct Layout {
  std::size_t vertices = 0, faces = 0;      ///< indices into Header::elements
  std::vector<std::vector<Step>> elements;  ///< the steps of each
  bool has_normals = false, has_uvs = false;
  std::vector<Attribute> of_vertices, of_faces;
};

/// Throws InputError when an element or property that a mesh needs is missing or of the wrong type. `text` is the
/// header's.
Layout plan_layout(const Header& header, std::string_view text, const std::string& file);

}  // namespace photonproof::ply
