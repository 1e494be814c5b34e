// A surface around one of its points: texture coordinates, what they change with, the shading normal. Parameterisations
// are Mitsuba 3's. All of it is computed anew from the point.
#pragma once

#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_shapes {

/// `frame`: as shape.h has it; meshes need none. `triangle`: of a mesh. `normal`: the geometric one.
LocalGeometry local_geometry(const Surface& surface, const AffineMap* frame, std::uint32_t triangle, const Vec3f& p,
                             const Vec3f& normal);

/// Whether the surface's shading normal is not its geometric one.
bool has_shading_normals(const Surface& surface);

/// Two unit vectors that are perpendicular to the unit vector n and to each other (Duff et al. 2017), as Mitsuba takes
/// them where a surface has no directions of its own.
struct Tangents {
  Vec3f s, t;
};
Tangents any_tangents(const Vec3f& n);

}  // namespace photonproof::inline renderer_shapes
