// What sampling a light yields, from a surface point or for a photon.
#pragma once

#include "scenes/vec.h"

namespace photonproof {

struct LightSample {
  Vec3f p_light;
  Vec3f normal_light;  ///< unit; zero for a point light
  Vec3f wi_world;      ///< unit, from the shaded point to the light
  Rgb radiance{0.0f};  ///< arriving along wi; for a point light: irradiance at normal incidence
  float pdf = 0;       ///< per solid angle at the shaded point; 1 for a point light; 0 when the light faces away
};

struct Emission {
  Vec3f p_world;
  Vec3f normal;     ///< unit; zero for a point light
  Vec3f direction;  ///< unit
  Rgb flux{0.0f};   ///< W: total flux of the light as this sample stands for it
};

/// Density per solid angle at `p` of a density `pdf_area` per area at `p_light`; 0 when seen edge-on or from behind.
inline float area_to_solid_angle(float pdf_area, const Vec3f& p, const Vec3f& p_light, const Vec3f& normal_light) {
  const Vec3f d = p - p_light;
  const float distance2 = dot(d, d);
  const float cos_light = dot(normal_light, d) / std::sqrt(distance2);
  return cos_light > 0 ? pdf_area * distance2 / cos_light : 0;
}

/// The sample of a surface light that draws `p_light` with a density per solid angle.
inline LightSample surface_light_sample(const Rgb& radiance, float pdf, const Vec3f& p, const Vec3f& p_light,
                                        const Vec3f& normal_light) {
  return {p_light, normal_light, normalize(p_light - p), radiance, pdf};
}

}  // namespace photonproof
