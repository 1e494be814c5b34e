// Reflectance of smooth interfaces for unpolarised light (Born and Wolf, Principles of Optics, sections 1.5 and 14.2).
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct DielectricFresnel {
  F reflectance;   ///< 1 at total internal reflection
  F cos_transmit;  ///< cosine of the refracted ray to the far side's normal, >= 0; 0 at total reflection
};

template <class F>
F clamp_to_unit(const F& x) {
  return lane_min(lane_max(x, F(0.0f)), F(1.0f));
}

/// `cos_incident` >= 0; `eta` = ior of the far side / ior of the side the ray comes from.
template <class F>
DielectricFresnel<F> fresnel_dielectric(const F& cos_incident, const F& eta) {
  const F cos2_transmit = 1 - (1 - cos_incident * cos_incident) / (eta * eta);
  const F cos_transmit = lane_sqrt(lane_max(cos2_transmit, F(0.0f)));
  const F parallel = (eta * cos_incident - cos_transmit) / (eta * cos_incident + cos_transmit);
  const F perpendicular = (cos_incident - eta * cos_transmit) / (cos_incident + eta * cos_transmit);
  const F reflectance = clamp_to_unit(F(0.5f * (parallel * parallel + perpendicular * perpendicular)));
  return {select(cos2_transmit > 0, reflectance, F(1.0f)), cos_transmit};
}

/// One channel of a conductor of relative complex ior eta + i k.
template <class F>
F fresnel_conductor(const F& cos_incident, const F& eta, const F& k) {
  const F cos2 = cos_incident * cos_incident;
  const F sin2 = 1 - cos2;
  const F t0 = eta * eta - k * k - sin2;
  const F a2_plus_b2 = lane_sqrt(F(t0 * t0 + 4 * eta * eta * k * k));
  const F a = lane_sqrt(lane_max(F(0.5f * (a2_plus_b2 + t0)), F(0.0f)));
  const F perpendicular_sum = a2_plus_b2 + cos2;
  const F perpendicular_cross = 2 * a * cos_incident;
  const F perpendicular = (perpendicular_sum - perpendicular_cross) / (perpendicular_sum + perpendicular_cross);
  const F parallel_sum = cos2 * a2_plus_b2 + sin2 * sin2;
  const F parallel_cross = perpendicular_cross * sin2;
  const F parallel = perpendicular * (parallel_sum - parallel_cross) / (parallel_sum + parallel_cross);
  return clamp_to_unit(F(0.5f * (perpendicular + parallel)));
}

template <class F>
Vec3<F> fresnel_conductor(const F& cos_incident, const Vec3<F>& eta, const Vec3<F>& k) {
  return {fresnel_conductor(cos_incident, eta.x, k.x), fresnel_conductor(cos_incident, eta.y, k.y),
          fresnel_conductor(cos_incident, eta.z, k.z)};
}

}  // namespace photonproof::inline renderer_bsdfs
