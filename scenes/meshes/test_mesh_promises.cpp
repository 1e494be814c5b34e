#include "scenes/meshes/test_mesh_promises.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/utf8.h"

namespace photonproof::inline scenes_meshes {

std::string problem_with(const TriangleMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  if (vertices == 0 || mesh.triangles.empty()) return "an empty mesh";
  if (!mesh.is_padded()) return "no padding";
  if (!mesh.normals.empty() && mesh.normals.size() != vertices) return "normals are not one a vertex";
  if (!mesh.uvs.empty() && mesh.uvs.size() != vertices) return "texture coordinates are not one a vertex";
  const auto finite = [](const Vec3f& v) { return is_finite(v); };
  if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), finite)) return "a position is not finite";
  if (!std::all_of(mesh.normals.begin(), mesh.normals.end(), finite)) return "a normal is not finite";
  for (const auto& uv : mesh.uvs)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "a texture coordinate is not finite";
  for (const TriangleMesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= vertices) return "an index out of range";
  return {};
}

std::string problem_with(const InputError& error, const std::string& file) {
  const std::string what = error.what();
  if (find_invalid_utf8(what) != std::string::npos) return "a message is not valid UTF-8";
  return error.summary().rfind(file + ":", 0) != 0 || what.rfind(error.summary(), 0) != 0 ? "a bad message" : "";
}

}  // namespace photonproof::inline scenes_meshes
