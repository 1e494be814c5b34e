#include "scenes/pbrt/mesh_data.h"

#include <cmath>

namespace photonproof::inline scenes_pbrt {
namespace {

std::vector<Vec3f> vectors(const PbrtParameters& p, const PbrtParameter& from) {
  if (from.numbers.size() % 3 != 0) p.fail(from, "expected three numbers of each");
  std::vector<Vec3f> result;
  result.reserve(from.numbers.size() / 3);
  for (std::size_t i = 0; i < from.numbers.size(); i += 3)
    result.push_back(Vec3f(Vec3d(from.numbers[i], from.numbers[i + 1], from.numbers[i + 2])));
  return result;
}

void read_vertices(const PbrtParameters& p, TriangleMesh& mesh) {
  const PbrtParameter* positions = p.find("P", {"point3", "point"});
  if (positions == nullptr) p.fail("expected vertices as \"point3 P\"");
  const std::vector<Vec3f> read = vectors(p, *positions);
  mesh.resize_positions(read.size());
  std::copy(read.begin(), read.end(), mesh.positions.begin());
  if (const PbrtParameter* normals = p.find("N", {"normal", "normal3"})) {
    mesh.normals = vectors(p, *normals);
    if (mesh.normals.size() != mesh.positions.size()) p.fail(*normals, "expected as many as vertices");
  }
  if (const PbrtParameter* uvs = p.find("uv", {"point2", "float", "vector2"})) {
    if (uvs->numbers.size() != 2 * mesh.positions.size()) p.fail(*uvs, "expected two numbers of each vertex");
    for (std::size_t i = 0; i < uvs->numbers.size(); i += 2)
      mesh.uvs.push_back({static_cast<float>(uvs->numbers[i]), static_cast<float>(uvs->numbers[i + 1])});
  }
}

/// Groups of `count` indices; without any, the vertices in their order.
std::vector<std::uint32_t> indices(const PbrtParameters& p, std::size_t vertices, std::size_t count) {
  std::vector<std::uint32_t> result;
  const PbrtParameter* given = p.find("indices", {"integer"});
  if (given == nullptr) {
    if (vertices != count) p.fail("expected \"integer indices\"");
    for (std::uint32_t i = 0; i < count; ++i) result.push_back(i);
    return result;
  }
  if (given->numbers.empty() || given->numbers.size() % count != 0)
    p.fail(*given, "expected " + std::to_string(count) + " numbers of each");
  for (const double number : given->numbers) {
    if (number < 0 || number >= static_cast<double>(vertices))
      p.fail(*given,
             "names vertex " + std::to_string(static_cast<long long>(number)) + " of " + std::to_string(vertices));
    result.push_back(static_cast<std::uint32_t>(number));
  }
  return result;
}

Vec3d face_of(const TriangleMesh& mesh, const TriangleMesh::Triangle& t) {
  const Vec3d a(mesh.positions[t[0]]);
  return cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a);
}

}  // namespace

TriangleMesh triangle_mesh_of(const PbrtParameters& p) {
  p.ignore({"S", "faceIndices"});
  TriangleMesh mesh;
  read_vertices(p, mesh);
  const std::vector<std::uint32_t> corners = indices(p, mesh.positions.size(), 3);
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return mesh;
}

TriangleMesh bilinear_mesh_of(const PbrtParameters& p, bool& is_bent) {
  p.ignore({"faceIndices"});
  TriangleMesh mesh;
  read_vertices(p, mesh);
  const std::vector<std::uint32_t> corners = indices(p, mesh.positions.size(), 4);
  const std::size_t patches = corners.size() / 4;
  is_bent = false;
  // Patches that name no coordinates have those of the unit square.
  const bool squares = mesh.uvs.empty();
  TriangleMesh result;
  result.resize_positions(4 * patches);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t from = corners[i];
    result.positions[i] = mesh.positions[from];
    if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[from]);
    result.uvs.push_back(squares ? Vec2<float>{i % 2 == 1 ? 1.0f : 0.0f, i % 4 >= 2 ? 1.0f : 0.0f} : mesh.uvs[from]);
  }
  for (std::uint32_t i = 0; i < 4 * patches; i += 4) {
    // The corners are at (u, v) = (0,0), (1,0), (0,1), (1,1).
    result.triangles.push_back({i, i + 1, i + 3});
    result.triangles.push_back({i, i + 3, i + 2});
    const Vec3d n = face_of(result, {i, i + 1, i + 3});
    const Vec3d out = Vec3d(result.positions[i + 2]) - Vec3d(result.positions[i]);
    is_bent = is_bent || std::abs(dot(n, out)) > 1e-4 * length(n) * length(out);
  }
  return result;
}

void turn_to_normals(TriangleMesh& mesh) {
  if (mesh.normals.empty()) return;
  for (TriangleMesh::Triangle& t : mesh.triangles) {
    const Vec3d mean = Vec3d(mesh.normals[t[0]]) + Vec3d(mesh.normals[t[1]]) + Vec3d(mesh.normals[t[2]]);
    if (dot(face_of(mesh, t), mean) < 0) std::swap(t[1], t[2]);
  }
}

void complete_coordinates(TriangleMesh& mesh) {
  if (mesh.uvs.empty()) {
    TriangleMesh apart;
    apart.resize_positions(3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = mesh.triangles[i][k];
        apart.positions[3 * i + k] = mesh.positions[from];
        if (!mesh.normals.empty()) apart.normals.push_back(mesh.normals[from]);
        apart.uvs.push_back({k > 0 ? 1.0f : 0.0f, k > 1 ? 1.0f : 0.0f});
      }
    for (std::uint32_t i = 0; i < 3 * mesh.triangles.size(); i += 3) apart.triangles.push_back({i, i + 1, i + 2});
    mesh = std::move(apart);
  }
  for (Vec2<float>& uv : mesh.uvs) uv.y = 1 - uv.y;
}

}  // namespace photonproof::inline scenes_pbrt
