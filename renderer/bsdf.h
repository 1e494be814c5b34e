// The closed set of BSDFs. Each lives in bsdf_<name>.h; this header is the interface they share.
// Directions are unit, in the local frame (z = normal), and point away from the surface; wo is where the history came
// from, wi where it goes. The cosine is never inside `eval`.
#pragma once

#include <optional>
#include <variant>

#include "renderer/bsdf_conductor.h"
#include "renderer/bsdf_dielectric.h"
#include "renderer/bsdf_diffuse.h"
#include "renderer/bsdf_sample.h"

namespace photonproof {

using Bsdf = std::variant<DiffuseBsdf, ConductorBsdf, DielectricBsdf>;

/// True where the BSDF is a sum of Dirac deltas: nothing to evaluate, next-event estimation cannot reach it.
inline bool is_delta(const Bsdf& bsdf) { return !std::holds_alternative<DiffuseBsdf>(bsdf); }

inline Rgb eval(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi) {
  return std::visit([&](const auto& b) { return b.eval(wo, wi); }, bsdf);
}
inline float pdf(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi) {
  return std::visit([&](const auto& b) { return b.pdf(wo, wi); }, bsdf);
}
inline std::optional<BsdfSample> sample(const Bsdf& bsdf, const Vec3f& wo, float u1, const Vec2<float>& u2,
                                        TransportMode mode) {
  return std::visit([&](const auto& b) { return b.sample(wo, u1, u2, mode); }, bsdf);
}

}  // namespace photonproof
