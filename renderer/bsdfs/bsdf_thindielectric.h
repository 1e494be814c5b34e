// A pane of smooth dielectric with both interfaces in one. Reflections between them are summed:
//   R + T R T (1 + R^2 + R^4 + ...) = 2 R / (1 + R).
// Transmitted light goes straight on.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/fresnel.h"
#include "scenes/base/faults.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct ThinDielectricBsdf {
  static constexpr bool has_smooth = false;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = true;
  F eta;  ///< ior of the pane / ior around it
  Vec3<F> reflectance, transmittance;

  Vec3<F> eval(const Vec3<F>&, const Vec3<F>&) const { return Vec3<F>(F(0.0f)); }
  F pdf(const Vec3<F>&, const Vec3<F>&) const { return F(0.0f); }
  BsdfSample<F> sample(const Vec3<F>& wo, const F& u, const Vec2<F>&, TransportMode) const {
    const F both = reflected_share(wo);
    const Mask<F> reflects = u < both;
    return {select(reflects, Vec3<F>(-wo.x, -wo.y, wo.z), -wo),
            select(reflects, reflectance, transmittance),
            select(reflects, both, F(1 - both)),
            F(1.0f),
            as_mask<F>(true),
            wo.z != 0};
  }
  /// Share of light along -wo that passes. As in Mitsuba, a pane does not interrupt the straight path of light behind
  /// it.
  Vec3<F> straight_through(const Vec3<F>& wo) const { return transmittance * F(1 - reflected_share(wo)); }
  /// The probability of reflection: where u < it.
  F reflected_share(const Vec3<F>& wo) const {
    const F once = fresnel_dielectric(lane_abs(wo.z), eta).reflectance;
    return has_fault(Fault::single_reflection) ? once : F(2 * once / (1 + once));
  }
};

}  // namespace photonproof::inline renderer_bsdfs
