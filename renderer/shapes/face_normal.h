// The normal of a triangle of any size.
#pragma once

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_shapes {

/// Unit, on the side that sees the edges counter-clockwise. The square of an area leaves single precision for edges
/// below 1e-9 and above 1e9: those use double. Undefined for a triangle without area.
inline Vec3f face_normal(const Vec3f& edge_u, const Vec3f& edge_v) {
  const Vec3f n = cross(edge_u, edge_v);
  const float square = dot(n, n);
  if (square > 1e-30f && square < 1e30f) [[likely]]
    return n / std::sqrt(square);
  return Vec3f(normalize(cross(Vec3d(edge_u), Vec3d(edge_v))));
}

}  // namespace photonproof::inline renderer_shapes
