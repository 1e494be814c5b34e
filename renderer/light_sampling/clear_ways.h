// The part of a light path's line on which it meets nothing. Some lights are so far away that a direction in single
// precision would miss the target. Their rays begin at the end of that part instead, on a line known by a point near
// its end.
#pragma once

#include <vector>

#include "renderer/lanes/lane.h"
#include "renderer/shapes/projection_cone.h"

namespace photonproof::inline renderer_light_sampling {

struct ClearWays {
  struct Wall {
    Vec3f point, normal;
  };
  /// Bounding ball for each light: all shapes except its own and infinite ones. A mesh may hide parts of itself and
  /// counts as other.
  std::vector<ProjectionTarget> others;
  std::vector<Wall> walls;  ///< infinite shapes
};

/// A point of a path's line up to which, from the light's point p on, it meets nothing. Not valid where that is nearer
/// to p than to the target.
template <class F>
struct PointAhead {
  Vec3<F> p;
  Mask<F> valid;
};

/// Computes that point; the line's own point is the one near its end.
template <class F>
PointAhead<F> point_ahead(const ClearWays& ways, const UInt<F>& light, const AimedLine<F>& line, const Vec3<F>& p) {
  const float* base = &ways.others.data()->center.x;
  const UInt<F> first = light * ProjectionTarget::stride;
  const Vec3<F> middle{gather(base, first), gather(base + 1, first), gather(base + 2, first)};
  // Steps back out of the ball of the other shapes, in any direction, and a little more.
  const F back = 1.001f * (length(Vec3<F>(line.point - middle)) + gather(base + 3, first));
  const Vec3<F> ahead = advance(line.point, F(-back), line.direction);
  Mask<F> valid = 2 * back < length(Vec3<F>(line.point - p));
  for (const ClearWays::Wall& wall : ways.walls) {
    const Vec3<F> point = broadcast<F>(wall.point), normal = broadcast<F>(wall.normal);
    valid = valid && dot(Vec3<F>(ahead - point), normal) * dot(Vec3<F>(p - point), normal) > 0;
  }
  return {ahead, valid};
}

}  // namespace photonproof::inline renderer_light_sampling
