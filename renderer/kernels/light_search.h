// Camera paths of a pilot (camera_pilot.h), which finds where ordinary paths would rarely meet a light.
//
// Rare by its lobes: smooth interfaces reflect as often as they refract. Let p be the probability of the lobe. Chosen
// with q = 1/2 instead, a path of value X has the weight p/q. It is multiplied by sqrt(p/q) instead, so that the mean
// of its square is that of ordinary samples: sum q (sqrt(p/q) X)^2 = sum p X^2.
//
// Rare by its size: the light is a ball of radius r at a distance d > r from a ray's nearest point. The ray counts r/d
// of its value inside the ball. Of n samples spread evenly around the light, the nearest one stands for an area of
// about (d/r)^2 discs of the ball. So the square of its value over n is again the mean square of all.
//
// Red and green of such a path are the light that it met, blue the largest value that it came near to.
#pragma once

#include "renderer/kernels/tasks.h"
#include "renderer/rays/surface_hit.h"

namespace photonproof::inline renderer_kernels {

/// Replaces the choice u < reflected at an interface that reflects the part `reflected`. It changes u, uniform in
/// [0,1), so that either lobe has probability 1/2, and returns sqrt(p/q) of the chosen one. With a single lobe nothing
/// changes.
template <class F>
F even_lobes(const F& reflected, F& u) {
  const Mask<F> two = reflected > 0 && reflected < 1;
  const Mask<F> reflects = u < 0.5f;
  const F twice = 2 * u;
  const F even = select(reflects, F(twice * reflected), F(reflected + (twice - 1) * (1 - reflected)));
  u = select(two, even, u);
  return select(two, F(lane_sqrt(F(2 * select(reflects, reflected, F(1 - reflected))))), F(1.0f));
}

/// Lights along the rays of `lanes`, as far as `hit`; s is a path's state.
template <class State, class F>
void find_lights(const LightSearch& search, State& s, const SurfaceHit<F>& hit, const Mask<F>& lanes) {
  if (!any(lanes)) return;
  const F end = select(hit.valid, F(lane_sqrt(length_squared(hit.p - s.origin))), F(1e30f));
  const F worth = max_component(s.throughput);
  for (std::size_t i = 0; i < search.count; ++i) {
    const LightBall& light = search.lights[i];
    const Vec3<F> to = Vec3<F>(F(light.center.x), F(light.center.y), F(light.center.z)) - s.origin;
    const F nearest = lane_min(lane_max(dot(to, s.direction), F(0.0f)), end);
    const F distance2 = length_squared(to - s.direction * nearest);
    const F radii2 = distance2 * (1 / (light.radius * light.radius));
    const F value = worth * light.radiance;
    const F met = select(lanes && radii2 < 1, value, F(0.0f));
    s.radiance.x += met, s.radiance.y += met;
    const Mask<F> near = lanes && radii2 < search.within * search.within;
    const F came = select(near, F(value / lane_sqrt(lane_max(radii2, F(1.0f)))), F(0.0f));
    s.radiance.z = lane_max(s.radiance.z, came);
  }
}

}  // namespace photonproof::inline renderer_kernels
