// What sampling a light yields, from a surface point or for a photon, a lane each.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof {

template <class F>
struct LightSample {
  Vec3<F> p_light;       ///< of an infinite light: beyond the scene, `reach_beyond` along wi
  Vec3<F> normal_light;  ///< unit; zero for lights of no surface
  Vec3<F> wi_world;      ///< unit, from the shaded point to the light
  Vec3<F> radiance;      ///< arriving along wi; for a delta light: irradiance at normal incidence
  F pdf;                 ///< per solid angle at the shaded point; 1 for a delta light; 0 when it gives nothing there
};

template <class F>
struct Emission {
  Vec3<F> p_world;
  Vec3<F> normal;     ///< unit; zero for lights of no surface
  Vec3<F> direction;  ///< unit
  Vec3<F> flux;       ///< W: what leaves the light, cosine inside, over the densities of position and direction
};

/// Densities of an emission, as scene_lights.h defines them.
template <class F>
struct EmissionPdfs {
  F position, direction;
};

/// Density per solid angle at `p` of a density `pdf_area` per area at `p_light`; 0 when seen edge-on or from behind.
template <class F>
F area_to_solid_angle(const F& pdf_area, const Vec3<F>& p, const Vec3<F>& p_light, const Vec3<F>& normal_light) {
  const Vec3<F> d = p - p_light;
  const F distance2 = dot(d, d);
  const F cos_light = dot(normal_light, d) / lane_sqrt(distance2);
  return select(cos_light > 0, pdf_area * distance2 / cos_light, F(0.0f));
}

/// How far from p a shadow segment to an infinite light goes. Within the ball around the scene nothing is beyond it;
/// infinite planes hide light up to a thousandth of a radian from their horizon.
template <class F>
F reach_beyond(const Vec3<F>& center, const F& radius, const Vec3<F>& p) {
  return 1024 * (radius + length(Vec3<F>(p - center)));
}

}  // namespace photonproof
