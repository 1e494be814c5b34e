// Rough conductor, one-sided: microfacets that are conductors (Walter et al. 2007, equation 20, with the Fresnel
// reflectance of metals). One reflection only: light that meets a second facet is lost.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/fresnel.h"
#include "renderer/bsdfs/microfacet.h"
#include "renderer/bsdfs/rough_part.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct RoughConductorBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = false;
  Microfacets<F> facets;
  Vec3<F> reflectance;
  F has_ior{0.0f};  ///< 1 or 0
  Vec3<F> eta, k;

  /// Reflectance of a facet at which light makes this cosine with the facet's normal.
  Vec3<F> facet_reflectance(const F& cos_facet) const {
    const Mask<F> with_ior = has_ior > 0;
    if (!any(with_ior)) return reflectance;
    return select(with_ior, reflectance * fresnel_conductor(cos_facet, eta, k), reflectance);
  }

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Mask<F> above = wo.z > 0 && wi.z > 0;
    const Vec3<F> m = half_vector(wo, wi);
    const F shape = facets.density(m) * facets.shadowing_by_cos(wo) * facets.shadowing_by_cos(wi) * 0.25f;
    return select(above, Vec3<F>(facet_reflectance(clamp_to_unit(dot(wo, m))) * shape), Vec3<F>(F(0.0f)));
  }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Vec3<F> m = half_vector(wo, wi);
    return select(wo.z > 0 && wi.z > 0, F(facets.pdf(wo, m) / (4 * lane_abs(dot(wo, m)))), F(0.0f));
  }
  Mask<F> is_rough(const RoughLimit& limit) const { return facets.are_rough(limit); }
  Mask<F> is_all_rough(const RoughLimit& limit) const { return is_rough(limit); }
  Vec3<F> rough_share(const RoughLimit& limit, const Vec3<F>&, const Vec3<F>&) const {
    return Vec3<F>(select(is_rough(limit), F(1.0f), F(0.0f)));
  }
  BsdfSample<F> sample(const Vec3<F>& wo, const F&, const Vec2<F>& u, TransportMode) const {
    const Vec3<F> m = facets.sample(wo, u);
    const F cos_facet = dot(wo, m);
    const Vec3<F> wi = mirrored(wo, m);
    const F shape = facets.shadowing_by_cos(wo) * facets.shadowing(wi) * facets.sampling_ratio(wo, m);
    const F density = facets.pdf(wo, m) / (4 * cos_facet);
    return {wi,
            facet_reflectance(clamp_to_unit(cos_facet)) * shape,
            density,
            F(1.0f),
            as_mask<F>(false),
            wo.z > 0 && wi.z > 0 && density > 0};
  }
};

}  // namespace photonproof::inline renderer_bsdfs
