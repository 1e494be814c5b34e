// Triangle meshes from Wavefront OBJ files. Files are untrusted: allocations are bounded by the file's own size.
#pragma once

#include <string>
#include <string_view>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_meshes {

constexpr std::size_t kMaxObjBytes = std::size_t{4} << 30;

/// Reads the statements v (its x y z), vt (its u v), vn and f of a file; others are skipped. Polygons are cut into fans
/// around their first corner, and corners that agree in position, texture coordinate and normal become one vertex.
/// Indices count from 1, or back from the last when negative. A corner without a texture coordinate in a file that has
/// some gets (0,0); normals count only when every corner has one. The mesh is padded. Throws InputError with
/// file:line:col.
TriangleMesh read_obj(const std::string& path);

/// The same for text already in memory; `file` stands for the file in messages.
TriangleMesh parse_obj(std::string_view text, const std::string& file);

}  // namespace photonproof::inline scenes_meshes
