#include "renderer/media/varying_medium.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace photonproof::inline renderer_media {
VaryingMedium::VaryingMedium(const HeterogeneousDescription& d, const VolumeFrame& frame, double factor)
    : sigma_t_(d.sigma_t, frame),
      albedo_(d.albedo, frame),
      scale_(static_cast<float>(factor * d.scale)),
      majorant_(static_cast<float>(factor * d.scale * max_component(most(d.sigma_t)))),
      scatters_(majorant_ > 0 && max_component(most(d.albedo)) > 0) {}

float VaryingMedium::next(float t, float u) const { return t - std::log1p(-u) / majorant_; }

/// Rounding must not lift it above the majorant.
Rgb VaryingMedium::extinction(const Vec3f& p) const {
  const Rgb sigma_t = sigma_t_.at(p) * scale_;
  return {std::min(sigma_t.x, majorant_), std::min(sigma_t.y, majorant_), std::min(sigma_t.z, majorant_)};
}

FreeFlight VaryingMedium::fly(const Rgb& throughput, const Vec3f& origin, const Vec3f& direction, float distance,
                              const PathSampler& draws) const {
  Rgb weight(1.0f);
  const Volume::Span span = sigma_t_.inside(origin, direction, distance);
  if (!(majorant_ > 0) || !(span.begin < span.end)) return {std::nullopt, weight};
  float t = span.begin;
  for (std::uint32_t draw = 0;; draw += 2) {
    t = next(t, draws.one(draw));
    if (!(t < span.end)) return {std::nullopt, weight};
    const Vec3f p = origin + direction * t;
    const Rgb extinction = this->extinction(p);
    const Rgb scattering = extinction * albedo_.at(p), nothing = Rgb(majorant_) - extinction;
    const Rgb path = throughput * weight;
    const float scatters = dot(path, scattering), goes_on = dot(path, nothing), both = scatters + goes_on;
    if (!(both > 0)) return {std::nullopt, Rgb(0.0f)};
    if (draws.one(draw + 1) * both < scatters) return {t, weight * scattering * (both / (majorant_ * scatters))};
    weight *= nothing * (both / (majorant_ * goes_on));
  }
}

Rgb VaryingMedium::transmittance(const Vec3f& origin, const Vec3f& direction, float distance,
                                 const PathSampler& draws) const {
  Rgb left(1.0f);
  const Volume::Span span = sigma_t_.inside(origin, direction, distance);
  if (!(majorant_ > 0) || !(span.begin < span.end)) return left;
  float t = span.begin;
  for (std::uint32_t draw = 0; max_component(left) > 0; ++draw) {
    t = next(t, draws.one(draw));
    if (!(t < span.end)) return left;
    left *= Rgb(1.0f) - extinction(origin + direction * t) / majorant_;
  }
  return left;
}

PathSampler draws_of_flight(PathSampler draws, std::uint32_t dimension) {
  draws.key = mix_bits(mix_bits(draws.key ^ 0x5bd1e995u) + dimension * 0x9e3779b9u);
  return draws;
}

}  // namespace photonproof::inline renderer_media
