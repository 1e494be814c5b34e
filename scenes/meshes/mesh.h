// Triangle meshes as stored in their files: shared vertices in the shape's local space, single precision.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_meshes {

/// Values beyond the shape, one colour a vertex or a triangle. A single number is a grey.
struct MeshAttribute {
  std::string name;  ///< begins with vertex_ or face_
  std::vector<Rgb> values;
  bool per_vertex() const { return name.starts_with("vertex_"); }
  friend bool operator==(const MeshAttribute&, const MeshAttribute&) = default;
};

struct TriangleMesh {
  using Triangle = std::array<std::uint32_t, 3>;

  /// Finite. Embree reads vertices 16 bytes at a time, past the end of the last one. Fill this only through
  /// resize_positions, which reserves that memory. A copy of the vector does not keep it.
  std::vector<Vec3f> positions;
  /// Indices of positions; counter-clockwise seen from the front.
  std::vector<Triangle> triangles;
  /// Per vertex, finite, unchanged from the file and so perhaps not of unit length; empty when the file has none.
  std::vector<Vec3f> normals;
  /// Per vertex, finite; empty when the file has none.
  std::vector<Vec2<float>> uvs;
  /// Finite. Files of PLY have them.
  std::vector<MeshAttribute> attributes;

  static constexpr std::size_t kPaddingVertices = 2;  ///< 24 bytes, of which Embree needs 16

  void resize_positions(std::size_t count) {
    positions.reserve(count + kPaddingVertices);
    positions.resize(count);
  }
  /// Whether 16 bytes after the last position may be read.
  bool is_padded() const { return positions.capacity() >= positions.size() + kPaddingVertices; }

  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Whether rays can meet a triangle of these positions.
inline bool has_area(const std::vector<Vec3f>& positions, const TriangleMesh::Triangle& triangle) {
  const Vec3d a(positions[triangle[0]]);
  return cross(Vec3d(positions[triangle[1]]) - a, Vec3d(positions[triangle[2]]) - a) != Vec3d(0.0);
}

}  // namespace photonproof::inline scenes_meshes
