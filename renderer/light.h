// The closed set of lights. Each lives in light_<name>.h and offers
//   sample(p, u)   a point of the light seen from p (next-event estimation), density per solid angle at p
//   pdf(...)       that density for a ray that found the light by itself (multiple importance sampling)
//   emit(u, v)     a photon's start; its flux is that of all photons together
//   flux()         total emitted flux, W per channel
#pragma once

#include <variant>

#include "renderer/light_point.h"
#include "renderer/light_quad.h"
#include "renderer/light_sample.h"
#include "renderer/light_sphere.h"

namespace photonproof {

using Light = std::variant<QuadLight, SphereLight, PointLight>;

/// A delta light cannot be found by a ray.
inline bool is_delta(const Light& light) { return std::holds_alternative<PointLight>(light); }

inline LightSample sample(const Light& light, const Vec3f& p, const Vec2<float>& u) {
  return std::visit([&](const auto& l) { return l.sample(p, u); }, light);
}
inline float pdf(const Light& light, const Vec3f& p, const Vec3f& p_light, const Vec3f& normal_light) {
  return std::visit([&](const auto& l) { return l.pdf(p, p_light, normal_light); }, light);
}
inline Emission emit(const Light& light, const Vec2<float>& u_position, const Vec2<float>& u_direction) {
  return std::visit([&](const auto& l) { return l.emit(u_position, u_direction); }, light);
}
inline Rgb flux(const Light& light) {
  return std::visit([](const auto& l) { return l.flux(); }, light);
}
/// Radiance from a point of the light whose normal makes `cos_emit` with the direction of travel; 0 from behind.
inline Rgb emitted_radiance(const Light& light, float cos_emit) {
  return std::visit([&](const auto& l) { return l.emitted_radiance(cos_emit); }, light);
}

}  // namespace photonproof
