// The ends of a pack's rays, and the offset with which rays leave a surface.
#pragma once

#include "renderer/core/ray.h"
#include "renderer/lanes/lane.h"
#include "scenes/base/numeric_faults.h"

namespace photonproof::inline renderer_rays {

template <class F>
struct SurfaceHit {
  Mask<F> valid{};
  Vec3<F> p, normal;    ///< normal: unit, geometric, on the surface's front side
  UInt<F> surface{};    ///< index into SceneView::surfaces; 0 where not valid
  UInt<F> primitive{};  ///< in a small scene
};

/// The point moved off its surface to the side `direction` points to, by 4 ulp of its coordinates. That is far enough
/// that the next ray cannot meet the surface by rounding, and close enough to leak through nothing.
template <class F>
Vec3<F> offset_from(const Vec3<F>& p, const Vec3<F>& normal, const Vec3<F>& direction, float coordinate_floor) {
  const F magnitude = lane_max(lane_max(lane_abs(p.x), lane_abs(p.y)), lane_max(lane_abs(p.z), F(coordinate_floor)));
  F step = F(4 * 0x1p-23f * magnitude);
  if (has_fault(NumericFault::fixed_step)) step = F(1e-4f);
  return advance(p, lane_copysign(step, dot(normal, direction)), normal);
}

}  // namespace photonproof::inline renderer_rays
