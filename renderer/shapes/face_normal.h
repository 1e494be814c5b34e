// The normal of a triangle of any size.
#pragma once

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_shapes {

/// Whether single precision holds the square of an area: not for edges below 1e-9 and above 1e9.
inline bool fits_single(float square) { return square > 1e-30f && square < 1e30f; }

/// Unit, on the side that sees the edges counter-clockwise; in double precision where single does not hold the area's
/// square. Undefined for a triangle without area.
inline Vec3f face_normal(const Vec3f& edge_u, const Vec3f& edge_v) {
  const Vec3f n = cross(edge_u, edge_v);
  const float square = dot(n, n);
  if (fits_single(square)) [[likely]]
    return n / std::sqrt(square);
  return Vec3f(normalize(cross(Vec3d(edge_u), Vec3d(edge_v))));
}

}  // namespace photonproof::inline renderer_shapes
