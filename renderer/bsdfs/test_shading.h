// Calls on the host's variant of BSDFs, for tests that work on any kind.
#pragma once

#include <optional>

#include "renderer/bsdfs/bsdf.h"

namespace photonproof::test {

inline Rgb eval(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi) {
  return std::visit([&](const auto& b) { return b.eval(wo, wi); }, bsdf);
}
inline float pdf(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi) {
  return std::visit([&](const auto& b) { return b.pdf(wo, wi); }, bsdf);
}
/// Empty where the path is absorbed.
inline std::optional<BsdfSample<float>> sample(const Bsdf& bsdf, const Vec3f& wo, float u_lobe,
                                               const Vec2<float>& u_direction, TransportMode mode) {
  const BsdfSample<float> drawn =
      std::visit([&](const auto& b) { return b.sample(wo, u_lobe, u_direction, mode); }, bsdf);
  return drawn.valid ? std::optional(drawn) : std::nullopt;
}

}  // namespace photonproof::test
