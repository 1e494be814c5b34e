// Rough plastic, one-sided: a diffuse base under a rough dielectric interface (Mitsuba's `roughplastic`). Microfacets
// give the interface's reflection and the share T(cos) that it lets through. interface_tables.cpp integrates T and fits
// it by a polynomial in sqrt(cos).
//   `f = F D G / (4 cos cos) + T(wo) T(wi) / (pi eta^2) x the base as in bsdf_plastic.h`.
#pragma once

#include "renderer/bsdfs/bsdf_plastic.h"
#include "renderer/bsdfs/microfacet.h"
#include "renderer/bsdfs/rough_part.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct RoughPlasticBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = false;
  static constexpr std::size_t coefficients = 16;
  Microfacets<F> facets;
  F eta;          ///< ior of the plastic / ior above it
  F lost_inside;  ///< share of diffuse light from below that the interface does not send back
  F nonlinear;    ///< 1 or 0
  Vec3<F> diffuse, specular;
  F through[coefficients];  ///< coefficients of Chebyshev's polynomials in 2 sqrt(cos) - 1

  /// Share of the light from this angle that reaches the base.
  F transmittance(const F& cos_theta) const {
    const F x = 2 * lane_sqrt(clamp_to_unit(cos_theta)) - 1;
    F later(0.0f), last(0.0f);  // Clenshaw 1955
    for (std::size_t k = coefficients; k-- > 1;) {
      const F next = mul_add(F(2 * x), last, F(through[k] - later));
      later = last;
      last = next;
    }
    return clamp_to_unit(mul_add(x, last, F(through[0] - later)));
  }

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    return select(wo.z > 0 && wi.z > 0, Vec3<F>(interface(wo, wi) + base(wo, wi)), Vec3<F>(F(0.0f)));
  }
  /// The base is always rough.
  Mask<F> is_rough(const RoughLimit&) const { return as_mask<F>(true); }
  Mask<F> is_all_rough(const RoughLimit& limit) const { return facets.are_rough(limit); }
  Vec3<F> rough_share(const RoughLimit& limit, const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Mask<F> rough_facets = facets.are_rough(limit);
    if (all(rough_facets)) return Vec3<F>(F(1.0f));
    const Vec3<F> below = base(wo, wi);
    return select(rough_facets, Vec3<F>(F(1.0f)), share_of<F>(below, Vec3<F>(below + interface(wo, wi))));
  }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Vec3<F> m = half_vector(wo, wi);
    const F p = gloss_probability(wo);
    const F density = p * facets.pdf(wo, m) / (4 * lane_abs(dot(wo, m))) + (1 - p) * cosine_hemisphere_pdf(wi.z);
    return select(wo.z > 0 && wi.z > 0, density, F(0.0f));
  }
  BsdfSample<F> sample(const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode) const {
    const Mask<F> glossy = u_lobe < gloss_probability(wo);
    const Vec3<F> wi = select(glossy, mirrored(wo, facets.sample(wo, u)), square_to_cosine_hemisphere(u));
    const F density = pdf(wo, wi);
    return {wi, eval(wo, wi) * F(wi.z / density), density, F(1.0f), as_mask<F>(false), density > 0};
  }

 private:
  Vec3<F> interface(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Vec3<F> m = half_vector(wo, wi);
    const F fresnel = fresnel_dielectric(clamp_to_unit(dot(wo, m)), eta).reflectance;
    const F shape = facets.density(m) * facets.shadowing_by_cos(wo) * facets.shadowing_by_cos(wi) * 0.25f;
    return specular * F(fresnel * shape);
  }
  Vec3<F> base(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F crossing = transmittance(wo.z) * transmittance(wi.z) / (eta * eta) * (1 / pi);
    return saturated(diffuse, lost_inside, nonlinear) * crossing;
  }
  F gloss_probability(const Vec3<F>& wo) const {
    const F t = transmittance(wo.z);
    return lobe_probability(F((1 - t) * mean_channel(specular)), F(t * mean_channel(diffuse)));
  }
};

}  // namespace photonproof::inline renderer_bsdfs
