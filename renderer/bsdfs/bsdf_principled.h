// Burley's principled BSDF (Burley 2012, 2015), with the meaning of Mitsuba 3's `principled`. It is a sum of lobes:
//   the main highlight, of GGX facets: a dielectric's exact Fresnel term, or Schlick's approximation where it is
//   tinted or a metal;
//   the base (principled_parts.h), on the share (1 - metallic) (1 - spec_trans);
//   glass, which passes the facets, on the share (1 - metallic) spec_trans, in the root of the colour (Walter et al.
//   2007, equation 21);
//   a clear coat.
// Mitsuba 3.9 in its scalar variants leaves out the sheen where spec_trans is exactly 1. Its others do not, nor do we.
// `PrincipledGlassBsdf` has all of them. Behind the surface it has glass and the facets' reflection. `PrincipledBsdf`
// has no glass and is black from behind. The normal points to the exterior; `eval` is for radiance that leaves along
// wo.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/principled_parts.h"

namespace photonproof::inline renderer_bsdfs {

template <class F, bool has_glass>
struct AnyPrincipledBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = has_glass;
  PrincipledBase<F> base;
  F anisotropic, metallic, spec_trans, spec_tint, clearcoat, clearcoat_gloss;
  F eta;                                          ///< interior ior / exterior ior; not 1 where there is glass
  F diffuse_rate, specular_rate, clearcoat_rate;  ///< weights of the lobes in sampling

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Facet facet = facet_between(wo, wi);
    const FacetFresnel<F> fresnel(facet.cos_wo, facet.eta_path);
    const Microfacets<F> facets = main_facets();
    const F shape = facets.density(facet.m) * facets.shadowing_by_cos(wo) * facets.shadowing_by_cos(wi);
    Vec3<F> f = highlight(fresnel) * F(0.25f * shape) + rest_in_front(facet, fresnel, wo, wi);
    if constexpr (has_glass) {
      f = select(wo.z > 0, f, Vec3<F>(F(0.25f * glass() * fresnel.dielectric * shape)));
      const F passed = (1 - fresnel.dielectric) * shape * facet.cos_wo * facet.cos_wi / facet.squared_length;
      f = select(facet.reflects, f, root(base.colour) * F(glass() * passed));
    }
    return select(facet.possible, f, Vec3<F>(F(0.0f)));
  }

  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Facet facet = facet_between(wo, wi);
    const Lobes lobes = choice(wo);
    const F in_front = select(wo.z > 0, F(1.0f), F(0.0f));
    F reflected = 0.25f / facet.cos_wo, passed(0.0f);
    if constexpr (has_glass) {
      const F through = transmitted_share(wo, FacetFresnel<F>(facet.cos_wo, facet.eta_path).dielectric);
      passed = through * facet.eta_path * facet.eta_path * facet.cos_wi / facet.squared_length;
      reflected = reflected * (1 - through);
    }
    F density = lobes.main * main_facets().pdf(upper(wo), facet.m) * select(facet.reflects, reflected, passed);
    F others = lobes.diffuse * cosine_hemisphere_pdf(lane_abs(wi.z));
    if (any(lobes.coat > 0)) others += lobes.coat * CoatFacets<F>(clearcoat_gloss).pdf(facet.m) * 0.25f / facet.cos_wo;
    density += select(facet.reflects, F(in_front * others), F(0.0f));
    return select(facet.possible, density, F(0.0f));
  }

  BsdfSample<F> sample(const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode mode) const {
    const Lobes lobes = choice(wo);
    const Vec3<F> wo_up = upper(wo);
    const Vec3<F> m = main_facets().sample(wo_up, u);
    const F eta_path = select(wo.z > 0, eta, 1 / eta);
    Vec3<F> wi_up = mirrored(wo_up, m);
    Mask<F> passes = as_mask<F>(false);
    if constexpr (has_glass) {
      const F cos_wo = dot(wo_up, m), to_path = 1 / eta_path;
      const DielectricFresnel<F> fresnel = fresnel_dielectric(clamp_to_unit(cos_wo), eta_path);
      passes = u_lobe > 1 - lobes.main * transmitted_share(wo, fresnel.reflectance);
      wi_up = select(passes, advance(Vec3<F>(-wo_up * to_path), F(cos_wo * to_path - fresnel.cos_transmit), m), wi_up);
    }
    const Mask<F> diffuse = u_lobe < lobes.diffuse, coat = !diffuse && u_lobe < lobes.diffuse + lobes.coat;
    if (any(diffuse)) wi_up = select(diffuse, square_to_cosine_hemisphere(u), wi_up);
    if (any(coat)) wi_up = select(coat, mirrored(wo_up, CoatFacets<F>(clearcoat_gloss).sample(u)), wi_up);
    const Vec3<F> wi = select(wo.z > 0, wi_up, Vec3<F>(-wi_up));

    const F density = pdf(wo, wi);
    Vec3<F> weight = eval(wo, wi) * F(lane_abs(wi.z) / density);
    if (has_glass && mode == TransportMode::importance) weight *= select(passes, F(eta_path * eta_path), F(1.0f));
    const Mask<F> right_side = select(passes, F(-wi_up.z), wi_up.z) > 0;
    return {wi,
            weight,
            density,
            select(passes, eta_path, F(1.0f)),
            as_mask<F>(false),
            wo.z != 0 && right_side && density > 0};
  }

  /// The base is always rough, facets and coat where they are wide. Light that passes, or comes from behind, is traced.
  Mask<F> is_rough(const RoughLimit& limit) const {
    const Mask<F> has_cloth = base.sheen > 0 && metallic < 1;
    return base_share() > 0 || has_cloth || main_facets().are_rough(limit) || (clearcoat > 0 && coat_is_rough(limit));
  }
  Mask<F> is_all_rough(const RoughLimit& limit) const requires(!has_glass) {
    return main_facets().are_rough(limit) && (clearcoat <= 0 || coat_is_rough(limit));
  }
  Vec3<F> rough_share(const RoughLimit& limit, const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Mask<F> in_front = wo.z > 0 && wi.z > 0;
    const Vec3<F> none(F(0.0f));
    if (!any(in_front)) return none;
    const Facet facet = facet_between(wo, wi);
    const FacetFresnel<F> fresnel(facet.cos_wo, facet.eta_path);
    const Microfacets<F> facets = main_facets();
    const F shape = facets.density(facet.m) * facets.shadowing_by_cos(wo) * facets.shadowing_by_cos(wi);
    const Vec3<F> main = highlight(fresnel) * F(0.25f * shape), below = diffuse(facet, wo, wi);
    const Vec3<F> over = Vec3<F>(coat_value(facet, fresnel, wo, wi));
    const Vec3<F> rough =
        below + select(facets.are_rough(limit), main, none) + select(coat_is_rough(limit), over, none);
    return select(in_front, share_of<F>(rough, Vec3<F>(below + main + over)), none);
  }

 private:
  /// The facet that turns one direction into the other.
  struct Facet {
    Vec3<F> m;         ///< above the surface
    F eta_path;        ///< ior beyond the surface / ior on wo's side
    F cos_wo, cos_wi;  ///< cosines of wo and wi to m, positive where possible
    F squared_length;  ///< squared length of wo + eta_path wi, or of wo + wi
    Mask<F> reflects, possible;
  };
  Facet facet_between(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Mask<F> reflects = has_glass ? wo.z * wi.z > 0 : as_mask<F>(true);
    const F eta_path = has_glass ? select(wo.z > 0, eta, 1 / eta) : eta;
    const Vec3<F> sum = has_glass ? advance(wo, select(reflects, F(1.0f), eta_path), wi) : wo + wi;
    const F squared_length = lane_max(dot(sum, sum), F(1e-30f));
    const Vec3<F> m = sum * lane_copysign(F(1 / lane_sqrt(squared_length)), sum.z);
    const F cos_wo = lane_copysign(F(1.0f), wo.z) * dot(wo, m), cos_wi = lane_copysign(F(1.0f), wi.z) * dot(wi, m);
    const Mask<F> facing = cos_wo > 0 && cos_wi > 0;
    if constexpr (has_glass)
      return {m,
              eta_path,
              cos_wo,
              cos_wi,
              squared_length,
              reflects,
              facing && wo.z * wi.z != 0 && (wo.z > 0 || glass() > 0)};
    else
      return {m, eta_path, cos_wo, cos_wi, squared_length, reflects, facing && wo.z > 0 && wi.z > 0};
  }
  static Vec3<F> upper(const Vec3<F>& v) { return select(v.z > 0, v, -v); }
  static Vec3<F> root(const Vec3<F>& v) { return {lane_sqrt(v.x), lane_sqrt(v.y), lane_sqrt(v.z)}; }

  Microfacets<F> main_facets() const { return principled_facets(base.roughness, anisotropic); }
  F glass() const { return has_glass ? F((1 - metallic) * spec_trans) : F(0.0f); }
  F base_share() const { return has_glass ? F((1 - metallic) * (1 - spec_trans)) : F(1 - metallic); }
  Mask<F> coat_is_rough(const RoughLimit& limit) const {
    return CoatFacets<F>(clearcoat_gloss).alpha >= limit.least_alpha;
  }

  /// Fresnel term of the main highlight in front. Where the indices are equal there is none, not even a metal's.
  Vec3<F> highlight(const FacetFresnel<F>& fresnel) const {
    const F tint = (1 - metallic) * spec_tint;
    Vec3<F> reflectance(F(fresnel.dielectric * (1 - metallic) * (1 - spec_tint)));
    if (any(metallic > 0)) reflectance += fresnel.schlick(base.colour) * metallic;
    if (any(tint > 0)) reflectance += fresnel.tinted(base.colour, eta) * tint;
    return select(fresnel.dielectric > 0, reflectance, Vec3<F>(F(0.0f)));
  }
  Vec3<F> diffuse(const Facet& facet, const Vec3<F>& wo, const Vec3<F>& wi) const {
    Vec3<F> f = base.diffuse(lane_abs(wo.z), lane_abs(wi.z), facet.cos_wi) * base_share();
    if (any(base.sheen > 0)) f += base.cloth(facet.cos_wi) * F(1 - metallic);
    return f;
  }
  F coat_value(const Facet& facet, const FacetFresnel<F>& fresnel, const Vec3<F>& wo, const Vec3<F>& wi) const {
    using Coat = CoatFacets<F>;
    if (!any(clearcoat > 0)) return F(0.0f);
    const F shadowing = lane_abs(wo.z * wi.z) * Coat::shadowing_by_cos(wo) * Coat::shadowing_by_cos(wi);
    return 0.25f * clearcoat * mul_add(fresnel.weight, F(0.96f), F(0.04f)) * Coat(clearcoat_gloss).density(facet.m) *
           shadowing;
  }
  /// Base and clear coat.
  Vec3<F> rest_in_front(const Facet& facet, const FacetFresnel<F>& fresnel, const Vec3<F>& wo,
                        const Vec3<F>& wi) const {
    return diffuse(facet, wo, wi) + Vec3<F>(coat_value(facet, fresnel, wo, wi));
  }

  /// Probabilities of the lobes. That of the facets is divided by the Fresnel term of the facet sampled.
  struct Lobes {
    F diffuse, coat, main;
  };
  Lobes choice(const Vec3<F>& wo) const {
    const F diffuse = base_share() * diffuse_rate, coat = 0.25f * clearcoat * clearcoat_rate;
    const F all_lobes = diffuse + coat + specular_rate, scale = 1 / lane_max(all_lobes, F(1e-30f));
    if constexpr (!has_glass) return {diffuse * scale, coat * scale, specular_rate * scale};
    const Mask<F> in_front = wo.z > 0;
    const F part = select(in_front, scale, F(0.0f));
    return {diffuse * part, coat * part, select(in_front, F(specular_rate * scale), F(1.0f))};
  }
  /// The probability that a sampled facet lets light through.
  F transmitted_share(const Vec3<F>& wo, const F& fresnel) const {
    return (1 - fresnel) * select(wo.z > 0, glass(), F(1.0f));
  }
};

template <class F>
using PrincipledBsdf = AnyPrincipledBsdf<F, false>;
template <class F>
using PrincipledGlassBsdf = AnyPrincipledBsdf<F, true>;

}  // namespace photonproof::inline renderer_bsdfs
