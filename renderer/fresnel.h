// Reflectance of smooth interfaces for unpolarised light (Born and Wolf, Principles of Optics, sections 1.5 and 14.2).
#pragma once

#include <algorithm>
#include <cmath>

#include "scenes/vec.h"

namespace photonproof {

struct DielectricFresnel {
  float reflectance;   ///< 1 at total internal reflection
  float cos_transmit;  ///< cosine of the refracted ray to the far side's normal, >= 0; 0 at total reflection
};

/// `cos_incident` >= 0; `eta` = ior of the far side / ior of the side the ray comes from.
inline DielectricFresnel fresnel_dielectric(float cos_incident, float eta) {
  const float sin2_transmit = (1 - cos_incident * cos_incident) / (eta * eta);
  if (sin2_transmit >= 1) return {1, 0};
  const float cos_transmit = std::sqrt(1 - sin2_transmit);
  const float parallel = (eta * cos_incident - cos_transmit) / (eta * cos_incident + cos_transmit);
  const float perpendicular = (cos_incident - eta * cos_transmit) / (cos_incident + eta * cos_transmit);
  return {std::clamp(0.5f * (parallel * parallel + perpendicular * perpendicular), 0.0f, 1.0f), cos_transmit};
}

/// One channel of a conductor of relative complex ior eta + i k.
inline float fresnel_conductor(float cos_incident, float eta, float k) {
  const float cos2 = cos_incident * cos_incident;
  const float sin2 = 1 - cos2;
  const float t0 = eta * eta - k * k - sin2;
  const float a2_plus_b2 = std::sqrt(t0 * t0 + 4 * eta * eta * k * k);
  const float a = std::sqrt(std::max(0.0f, 0.5f * (a2_plus_b2 + t0)));
  const float perpendicular_sum = a2_plus_b2 + cos2;
  const float perpendicular_cross = 2 * a * cos_incident;
  const float perpendicular = (perpendicular_sum - perpendicular_cross) / (perpendicular_sum + perpendicular_cross);
  const float parallel_sum = cos2 * a2_plus_b2 + sin2 * sin2;
  const float parallel_cross = perpendicular_cross * sin2;
  const float parallel = perpendicular * (parallel_sum - parallel_cross) / (parallel_sum + parallel_cross);
  return std::clamp(0.5f * (perpendicular + parallel), 0.0f, 1.0f);
}

inline Rgb fresnel_conductor(float cos_incident, const Rgb& eta, const Rgb& k) {
  return {fresnel_conductor(cos_incident, eta.x, k.x), fresnel_conductor(cos_incident, eta.y, k.y),
          fresnel_conductor(cos_incident, eta.z, k.z)};
}

}  // namespace photonproof
