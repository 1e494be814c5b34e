// Plastic, one-sided: a diffuse base under a smooth dielectric interface (Mitsuba's `plastic`). The interface reflects
// the share R of the base's light back to the base, again and again. The sum is a geometric series, as in Kubelka and
// Munk (Saunderson's correction, 1942).
//   `f = T(wo) T(wi) / (pi eta^2) rho / (1 - R)`      linear
//   `f = T(wo) T(wi) / (pi eta^2) rho / (1 - rho R)`  nonlinear, the physical one
// The interface adds a mirror of Fresnel's reflectance. Records hold 1 - R: at high indices single precision would
// round R to 1.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/fresnel.h"
#include "renderer/bsdfs/rough_part.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
F mean_channel(const Vec3<F>& c) {
  return (c.x + c.y + c.z) * (1.0f / 3);
}

/// Effective reflectance of a diffuse base under an interface that returns 1 - `lost` of its light. Crossings are not
/// included.
template <class F>
Vec3<F> between_reflections(const Vec3<F>& diffuse, const Vec3<F>& lost) {
  return diffuse / (Vec3<F>(F(1.0f)) - diffuse + diffuse * lost);
}
template <class F>
Vec3<F> saturated(const Vec3<F>& diffuse, const F& lost, const F& nonlinear) {
  return select(nonlinear > 0, between_reflections(diffuse, Vec3<F>(lost)), diffuse / lost);
}

/// Probability of choosing the specular one of two lobes of these strengths; 0 where both strengths are 0.
template <class F>
F lobe_probability(const F& specular, const F& diffuse) {
  const F both = specular + diffuse;
  return select(both > 0, F(specular / both), F(0.0f));
}

template <class F>
struct PlasticBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = false;
  F eta;          ///< ior of the plastic / ior above it
  F lost_inside;  ///< share of diffuse light from below that the interface does not send back
  F nonlinear;    ///< 1 or 0
  Vec3<F> diffuse, specular;

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F crossing = transmittance(wo.z) * transmittance(wi.z) / (eta * eta) * (1 / pi);
    return select(wo.z > 0 && wi.z > 0, Vec3<F>(saturated(diffuse, lost_inside, nonlinear) * crossing),
                  Vec3<F>(F(0.0f)));
  }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    return select(wo.z > 0, F((1 - mirror_probability(wo)) * cosine_hemisphere_pdf(wi.z)), F(0.0f));
  }
  /// Everything except the mirror is rough.
  Mask<F> is_rough(const RoughLimit&) const { return as_mask<F>(true); }
  Vec3<F> rough_share(const RoughLimit&, const Vec3<F>&, const Vec3<F>&) const { return Vec3<F>(F(1.0f)); }
  BsdfSample<F> sample(const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode) const {
    const F p = mirror_probability(wo);
    const Mask<F> mirrors = u_lobe < p;
    const Vec3<F> scattered = square_to_cosine_hemisphere(u);
    const Vec3<F> wi = select(mirrors, Vec3<F>(-wo.x, -wo.y, wo.z), scattered);
    const F crossing = transmittance(wo.z) * transmittance(wi.z) / (eta * eta * (1 - p));
    return {wi,
            select(mirrors, specular * F(fresnel_dielectric(wo.z, eta).reflectance / p),
                   saturated(diffuse, lost_inside, nonlinear) * crossing),
            select(mirrors, p, F((1 - p) * cosine_hemisphere_pdf(wi.z))),
            F(1.0f),
            mirrors,
            wo.z > 0 && wi.z > 0};
  }

 private:
  F transmittance(const F& cos_theta) const {
    return 1 - fresnel_dielectric(lane_max(cos_theta, F(0.0f)), eta).reflectance;
  }
  F mirror_probability(const Vec3<F>& wo) const {
    const F t = transmittance(wo.z);
    return lobe_probability(F((1 - t) * mean_channel(specular)), F(t * mean_channel(diffuse)));
  }
};

}  // namespace photonproof::inline renderer_bsdfs
