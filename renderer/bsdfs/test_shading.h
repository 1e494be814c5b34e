// The host's variants of BSDFs and lights called as one, for tests that do not care which kind they have.
#pragma once

#include <optional>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/light_choice/emission_guide.h"

namespace photonproof::test {

inline Rgb eval(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi) {
  return std::visit([&](const auto& b) { return b.eval(wo, wi); }, bsdf);
}
inline float pdf(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi) {
  return std::visit([&](const auto& b) { return b.pdf(wo, wi); }, bsdf);
}
/// Nothing where the history is absorbed.
inline std::optional<BsdfSample<float>> sample(const Bsdf& bsdf, const Vec3f& wo, float u_lobe,
                                               const Vec2<float>& u_direction, TransportMode mode) {
  const BsdfSample<float> drawn =
      std::visit([&](const auto& b) { return b.sample(wo, u_lobe, u_direction, mode); }, bsdf);
  return drawn.valid ? std::optional(drawn) : std::nullopt;
}

inline LightSample<float> sample(const Light& light, const Vec3f& p, const Vec2<float>& u) {
  return std::visit([&](const auto& l) { return l.sample(p, u); }, light);
}
inline float pdf(const Light& light, const Vec3f& p, const Vec3f& p_light, const Vec3f& normal_light) {
  return density_from(light, p, p_light, normal_light, 0);
}
inline Emission<float> emit(const Light& light, const Vec2<float>& u_position, const Vec2<float>& u_direction) {
  return std::visit([&](const auto& l) { return l.emit(u_position, u_direction); }, light);
}

}  // namespace photonproof::test
