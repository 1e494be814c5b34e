// Where on its way light has met nothing yet. A light's ray that is aimed from so far away that a direction in single
// precision would miss what it is aimed at begins there instead, on a line that is known by a point near its end.
#pragma once

#include <vector>

#include "renderer/lanes/lane.h"
#include "renderer/shapes/projection_cone.h"

namespace photonproof::inline renderer_light_sampling {

struct ClearWays {
  struct Wall {
    Vec3f point, normal;
  };
  /// Of each light: all shapes but its own and those without end. A mesh may hide parts of itself and counts as others.
  std::vector<ProjectionTarget> others;
  std::vector<Wall> walls;  ///< shapes without end
};

/// A point of a path's line from the light's point p that nothing is before; not valid where that is nearer to p than
/// to what is aimed at.
template <class F>
struct PointAhead {
  Vec3<F> p;
  Mask<F> valid;
};

/// The line's point is the one near its end.
template <class F>
PointAhead<F> point_ahead(const ClearWays& ways, const UInt<F>& light, const AimedLine<F>& line, const Vec3<F>& p) {
  const float* base = &ways.others.data()->center.x;
  const UInt<F> first = light * ProjectionTarget::stride;
  const Vec3<F> middle{gather(base, first), gather(base + 1, first), gather(base + 2, first)};
  // Out of the ball of the others, whichever way, and a little more.
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
