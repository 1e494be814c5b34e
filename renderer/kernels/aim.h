// Directions from a light's points into the cones of the aim targets, drawn uniformly from one cone of all:
//   p(d) = 1/K sum over the K cones that hold d of 1 / (their solid angle)
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/scene/scene_view.h"
#include "renderer/shapes/aim_cone.h"

namespace photonproof {

template <class F>
struct AimedDirection {
  Vec3<F> direction;
  F pdf;  ///< per solid angle
};

/// `u_target` picks the cone, `u` the direction in it.
template <class F>
AimedDirection<F> aim(const SceneView& scene, const Vec3<F>& p, const F& u_target, const Vec2<F>& u) {
  const auto count = static_cast<float>(scene.aim_target_count);
  const UInt<F> which = to_uint(lane_min(F(u_target * count), F(count - 1))) * AimTarget::stride;
  const float* base = &scene.aim_targets->center.x;
  const Vec3<F> center{gather(base, which), gather(base + 1, which), gather(base + 2, which)};
  const AimCone<F> drawn = cone_towards(center, gather(base + 3, which), p);
  const Vec3<F> direction = normalize(Frame<F>(drawn.axis).to_world(square_to_cone(u, drawn.one_minus_cos)));

  F pdf(0.0f);
  for (std::uint32_t k = 0; k < scene.aim_target_count; ++k) {
    const AimTarget& target = scene.aim_targets[k];
    const AimCone<F> cone = cone_towards(broadcast<F>(target.center), F(target.radius), p);
    pdf += select(cone.holds(direction), 1 / cone.one_minus_cos, F(0.0f));
  }
  return {direction, pdf * (1 / (2 * pi * count))};
}

}  // namespace photonproof
