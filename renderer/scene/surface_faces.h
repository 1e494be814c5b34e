// The flat faces of a surface, whatever it is made of.
#pragma once

#include "renderer/shapes/extent.h"
#include "renderer/shapes/surface.h"

namespace photonproof {

struct FlatFace {
  Vec3d corner, u, v;  ///< corner + s u + t v
  bool is_triangle = false;
};

inline Extent extent_of_face(const FlatFace& face) {
  Extent box;
  for (const Vec3d& p : {face.corner, face.corner + face.u, face.corner + face.v}) box.add(p);
  if (!face.is_triangle) box.add(face.corner + face.u + face.v);
  return box;
}

/// Whether p is in the box, or so near to it along every axis.
inline bool comes_near(const Extent& box, const Vec3d& p, double distance) {
  const auto along = [&](double Vec3d::*axis) {
    return p.*axis >= box.low.*axis - distance && p.*axis <= box.high.*axis + distance;
  };
  return along(&Vec3d::x) && along(&Vec3d::y) && along(&Vec3d::z);
}

/// Calls visit(const FlatFace&) for all of a parallelogram, a mesh or an instance.
template <class Visit>
void for_each_face(const Surface& surface, Visit&& visit) {
  const auto tell = [&](std::size_t primitive, const FlatFace& face) {
    if (const LongFace* exact = surface.long_face(primitive))
      visit(FlatFace{exact->corner, exact->edge_u, exact->edge_v, exact->is_triangle});
    else
      visit(face);
  };
  if (const auto* quad = std::get_if<Quad>(&surface.geometry))
    tell(0, {Vec3d(quad->corner), Vec3d(quad->edge_u), Vec3d(quad->edge_v)});
  const Mesh* mesh = mesh_of(surface.geometry);
  if (mesh == nullptr) return;
  const auto* copy = std::get_if<MeshInstance>(&surface.geometry);
  for (std::size_t i = 0; i < mesh->triangle_count(); ++i) {
    const auto corner = [&](std::size_t k) {
      const Vec3f p = mesh->corner(i, k);
      return Vec3d(copy != nullptr ? copy->placement->point(p) : p);
    };
    const Vec3d a = corner(0);
    tell(i, {a, corner(1) - a, corner(2) - a, true});
  }
}

}  // namespace photonproof
