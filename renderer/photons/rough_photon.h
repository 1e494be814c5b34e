// Photons on rough parts of BSDFs (rough_part.h) are gathered by the direction they came from. The direction, 2 x 16
// bits, replaces the blue of other photons. The colour replaces their red and green: the largest channel, and the
// channels' shares of it in 3 x 10 bits, with an error of at most 0.05 % of it. So every photon has 32 bytes. Their
// surface's number has the bit PhotonSurface::rough, by which other gathers leave them out.
#pragma once

#include <cstdint>

#include "renderer/lanes/warp.h"
#include "renderer/photons/surface_side.h"

namespace photonproof::inline renderer_photons {

/// Three columns of a photon in place of its flux.
template <class F>
struct RoughPhotonWords {
  F largest;
  UInt<F> shares, direction;
};

constexpr int rough_direction_bits = 16, rough_share_bits = 10;

/// `flux` > 0 in some channel; `to_light` unit, in the world.
template <class F>
RoughPhotonWords<F> rough_photon_words(const Vec3<F>& flux, const Vec3<F>& to_light) {
  constexpr float most = (1 << rough_share_bits) - 1;
  const F largest = max_component(flux), scale = F(most) / largest;
  const auto share = [&](const F& channel) { return to_uint(F(channel * scale + 0.5f)); };
  const UInt<F> shares =
      (share(flux.x) * (1u << rough_share_bits) + share(flux.y)) * (1u << rough_share_bits) + share(flux.z);
  return {largest, shares, octahedral_word<rough_direction_bits>(to_light)};
}

template <class F>
Vec3<F> flux_of_rough_photon(const RoughPhotonWords<F>& words) {
  constexpr std::uint32_t mask = (1u << rough_share_bits) - 1;
  const F scale = words.largest * (1 / static_cast<float>(mask));
  const auto channel = [&](int shift) { return to_float(UInt<F>((words.shares >> shift) & mask)) * scale; };
  return {channel(2 * rough_share_bits), channel(rough_share_bits), channel(0)};
}

/// Unit vector.
template <class F>
Vec3<F> direction_of_rough_photon(const RoughPhotonWords<F>& words) {
  constexpr float steps = (1 << (rough_direction_bits - 1)) - 1;
  constexpr std::uint32_t mask = (1u << rough_direction_bits) - 1;
  const F u = to_float(UInt<F>((words.direction >> rough_direction_bits) & mask)) - steps;
  const F v = to_float(UInt<F>(words.direction & mask)) - steps;
  const F z = F(steps) - lane_abs(u) - lane_abs(v);
  const F fold = lane_min(z, F(0.0f));  // below the equator the corners are folded over
  return normalize(Vec3<F>{u - lane_copysign(fold, u), v - lane_copysign(fold, v), z});
}

}  // namespace photonproof::inline renderer_photons
