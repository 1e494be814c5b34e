// Mesh properties for tests: topology, orientation, and exact bits.
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <utility>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_meshes {

struct EdgeCounts {
  std::size_t inner = 0;   ///< between two triangles that agree on the front
  std::size_t border = 0;  ///< of one triangle
  std::size_t bad = 0;     ///< of triangles that disagree, or of more than two
};

inline EdgeCounts count_edges(const std::vector<TriangleMesh::Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<int, int>> uses;  // forwards, backwards
  for (const TriangleMesh::Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      ++(a < b ? uses[{a, b}].first : uses[{b, a}].second);
    }
  EdgeCounts counts;
  for (const auto& [edge, use] : uses) {
    if (use == std::pair(1, 1))
      ++counts.inner;
    else if (use.first + use.second == 1)
      ++counts.border;
    else
      ++counts.bad;
  }
  return counts;
}

/// Normal of length twice the area.
inline Vec3d normal_of(const TriangleMesh& mesh, const TriangleMesh::Triangle& t) {
  const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return cross(b - a, c - a);
}

/// FNV-1a over the bytes of positions and triangles.
inline std::uint64_t fingerprint(const TriangleMesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) hash = (hash ^ (word >> shift & 255)) * 0x100000001b3u;
  };
  for (const Vec3f& p : mesh.positions)
    for (const float v : {p.x, p.y, p.z}) add(std::bit_cast<std::uint32_t>(v));
  for (const TriangleMesh::Triangle& t : mesh.triangles)
    for (const std::uint32_t corner : t) add(corner);
  return hash;
}

}  // namespace photonproof::inline scenes_meshes
