#include "renderer/shapes/local_geometry.h"

#include <cmath>

#include "renderer/lanes/warp.h"
#include "renderer/shapes/face_normal.h"
#include "scenes/base/faults.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_shapes {
namespace {

/// Barycentric coordinates of the point nearest to p0 + q in the plane of a triangle at p0 with these edges.
Vec2<float> barycentric_of(const Vec3f& edge_u, const Vec3f& edge_v, const Vec3f& to_point) {
  const Vec3d e(edge_u), f(edge_v), q(to_point);
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), qe = dot(q, e), qf = dot(q, f);
  const double determinant = ee * ff - ef * ef;
  return {static_cast<float>((qe * ff - qf * ef) / determinant), static_cast<float>((qf * ee - qe * ef) / determinant)};
}

/// `p` in the mesh's own space.
LocalGeometry on_mesh(const Mesh& mesh, std::uint32_t triangle, const Vec3f& p, const Vec3f& face_normal) {
  const auto& corners = mesh.source->triangles[triangle];
  const Vec3f p0 = mesh.positions[corners[0]];
  const Vec3f edge_u = mesh.positions[corners[1]] - p0, edge_v = mesh.positions[corners[2]] - p0;
  const auto [b1, b2] = barycentric_of(edge_u, edge_v, p - p0);
  const float b0 = 1 - b1 - b2;

  const float side = mesh.inward ? -1.0f : 1.0f;
  const Tangents around = any_tangents(face_normal * side);
  LocalGeometry local{{b1, b2}, around.s, around.t, face_normal};
  if (!mesh.source->uvs.empty()) {
    const auto uv_of = [&](std::size_t k) {
      const Vec2<float> uv = mesh.source->uvs[corners[k]];
      return Vec2<float>{uv.x, mesh.flip_v ? 1 - uv.y : uv.y};
    };
    const Vec2<float> uv0 = uv_of(0), uv1 = uv_of(1), uv2 = uv_of(2);
    local.uv = {uv0.x * b0 + uv1.x * b1 + uv2.x * b2, uv0.y * b0 + uv1.y * b1 + uv2.y * b2};
    const Vec2<float> du{uv1.x - uv0.x, uv2.x - uv0.x}, dv{uv1.y - uv0.y, uv2.y - uv0.y};  // along the two edges
    const float area = du.x * dv.y - dv.x * du.y;
    if (area != 0) {
      local.dp_du = (edge_u * dv.y - edge_v * dv.x) / area;
      local.dp_dv = (edge_v * du.x - edge_u * du.y) / area;
    }
  }
  if (!mesh.normals.empty() && !has_fault(Fault::flat_normals)) {
    const Vec3f n = mesh.normals[corners[0]] * b0 + mesh.normals[corners[1]] * b1 + mesh.normals[corners[2]] * b2;
    const float norm = length(n);
    if (norm > 0) local.normal = n * (side / norm);
  }
  return local;
}

LocalGeometry on_instance(const MeshInstance& copy, std::uint32_t triangle, const Vec3f& p) {
  const AffineMap& map = *copy.placement;
  const Mesh& mesh = *copy.mesh;
  const Vec3f corner = mesh.corner(triangle, 0);
  const Vec3f winding = face_normal(mesh.corner(triangle, 1) - corner, mesh.corner(triangle, 2) - corner);
  const LocalGeometry local = on_mesh(mesh, triangle, map.local_point(p), mesh.inward ? -winding : winding);
  return {local.uv, map.vector(local.dp_du), map.vector(local.dp_dv), normalize(map.normal(local.normal))};
}

}  // namespace

LocalGeometry local_geometry(const Surface& surface, const AffineMap* frame, std::uint32_t triangle, const Vec3f& p,
                             const Vec3f& normal) {
  return std::visit(Overloaded{[&](const Mesh& mesh) { return on_mesh(mesh, triangle, p, normal); },
                               [&](const MeshInstance& copy) { return on_instance(copy, triangle, p); },
                               [&](const Curves& curves) { return local_geometry(curves, triangle, p, normal); },
                               [&](const Ellipsoids& e) { return local_geometry(e, normal); },
                               [&](const auto& shape) { return local_geometry(shape, *frame, p, normal); }},
                    surface.geometry);
}

Vec2<float> barycentric(const Surface& surface, std::uint32_t triangle, const Vec3f& p) {
  const Mesh& mesh = *mesh_of(surface.geometry);
  const auto* copy = std::get_if<MeshInstance>(&surface.geometry);
  const Vec3f p0 = mesh.corner(triangle, 0);
  return barycentric_of(mesh.corner(triangle, 1) - p0, mesh.corner(triangle, 2) - p0,
                        (copy != nullptr ? copy->placement->local_point(p) : p) - p0);
}

bool has_shading_normals(const Surface& surface) {
  if (const auto* sdf = std::get_if<SdfGrid>(&surface.geometry)) return sdf->smooth;
  const Mesh* mesh = mesh_of(surface.geometry);
  return mesh != nullptr && !mesh->normals.empty();
}

Tangents any_tangents(const Vec3f& n) {
  const Frame<float> frame(n);
  return {frame.s, frame.t};
}

}  // namespace photonproof::inline renderer_shapes
