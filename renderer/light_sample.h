// What sampling a light yields, from a surface point or for a photon, a lane each.
#pragma once

#include "renderer/lane.h"

namespace photonproof {

template <class F>
struct LightSample {
  Vec3<F> p_light;
  Vec3<F> normal_light;  ///< unit; zero for a point light
  Vec3<F> wi_world;      ///< unit, from the shaded point to the light
  Vec3<F> radiance;      ///< arriving along wi; for a point light: irradiance at normal incidence
  F pdf;                 ///< per solid angle at the shaded point; 1 for a point light; 0 when the light faces away
};

template <class F>
struct Emission {
  Vec3<F> p_world;
  Vec3<F> normal;     ///< unit; zero for a point light
  Vec3<F> direction;  ///< unit
};

/// Density per solid angle at `p` of a density `pdf_area` per area at `p_light`; 0 when seen edge-on or from behind.
template <class F>
F area_to_solid_angle(const F& pdf_area, const Vec3<F>& p, const Vec3<F>& p_light, const Vec3<F>& normal_light) {
  const Vec3<F> d = p - p_light;
  const F distance2 = dot(d, d);
  const F cos_light = dot(normal_light, d) / lane_sqrt(distance2);
  return select(cos_light > 0, pdf_area * distance2 / cos_light, F(0.0f));
}

}  // namespace photonproof
