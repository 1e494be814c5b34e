// A surface around one of its points: texture coordinates, their derivatives, the shading normal. Parameterisations are
// Mitsuba 3's. All of it is computed anew from the point.
#pragma once

#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_shapes {

/// `frame` as in shape.h; meshes and curves need none. `triangle`: a mesh's, or a curve's segment. `normal`: the
/// geometric one.
LocalGeometry local_geometry(const Surface& surface, const AffineMap* frame, std::uint32_t triangle, const Vec3f& p,
                             const Vec3f& normal);

/// The barycentric coordinates of the second and third corner at p; the surface is a mesh or a copy of one.
Vec2<float> barycentric(const Surface& surface, std::uint32_t triangle, const Vec3f& p);

/// Whether the surface's shading normal differs from its geometric one.
bool has_shading_normals(const Surface& surface);

/// Two unit vectors perpendicular to the unit vector n and to each other (Duff et al. 2017). Mitsuba uses the same
/// where a surface has no directions of its own.
struct Tangents {
  Vec3f s, t;
};
Tangents any_tangents(const Vec3f& n);

}  // namespace photonproof::inline renderer_shapes
