// No surface: paths go straight on. A border between media, or where a mask has a hole.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct NullBsdf {
  static constexpr bool has_smooth = false;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = true;
  Vec3<F> transmittance{F(1.0f)};

  Vec3<F> eval(const Vec3<F>&, const Vec3<F>&) const { return Vec3<F>(F(0.0f)); }
  F pdf(const Vec3<F>&, const Vec3<F>&) const { return F(0.0f); }
  /// Share of light that continues as if nothing were there.
  Vec3<F> straight_through(const Vec3<F>&) const { return transmittance; }
  BsdfSample<F> sample(const Vec3<F>& wo, const F&, const Vec2<F>&, TransportMode) const {
    return {-wo, transmittance, F(1.0f), F(1.0f), as_mask<F>(true), as_mask<F>(true)};
  }
};

}  // namespace photonproof::inline renderer_bsdfs
