// Directions from a light's points into the cones of the aim targets, sampled uniformly in one uniformly chosen cone.
//   The density is p(d) = 1/K sum over the K cones that hold d of 1 / (their solid angle).
#pragma once

#include "renderer/scene/scene_view.h"
#include "renderer/shapes/projection_cone.h"

namespace photonproof::inline renderer_kernels {

template <class F>
struct Aimed {
  AimedLine<F> line;
  F pdf;  ///< per solid angle
};

/// `u_target` picks the cone, `u` the direction in it.
template <class F>
Aimed<F> aim(const SceneView& scene, const Vec3<F>& p, const F& u_target, const Vec2<F>& u) {
  const auto count = static_cast<float>(scene.projection_target_count);
  const UInt<F> which = to_uint(lane_min(F(u_target * count), F(count - 1))) * ProjectionTarget::stride;
  const float* base = &scene.projection_targets->center.x;
  const Vec3<F> center{gather(base, which), gather(base + 1, which), gather(base + 2, which)};
  const AimedLine<F> line = aimed_line(center, F(gather(base + 3, which)), p, u);

  F pdf(0.0f);
  for (std::uint32_t k = 0; k < scene.projection_target_count; ++k) {
    const ProjectionTarget& target = scene.projection_targets[k];
    pdf += projection_pdf(broadcast<F>(target.center), F(target.radius), p, line);
  }
  return {line, pdf * (1 / count)};
}

}  // namespace photonproof::inline renderer_kernels
