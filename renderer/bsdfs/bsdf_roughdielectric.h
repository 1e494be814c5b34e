// Rough dielectric: microfacets that reflect and refract (Walter, Marschner, Li and Torrance 2007, equations 20 and
// 21). The normal points to the exterior. `eval` is the value for radiance that leaves along wo; swap the directions
// for importance. Light that meets a second facet is lost.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/fresnel.h"
#include "renderer/bsdfs/microfacet.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct RoughDielectricBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = true;
  Microfacets<F> facets;
  F eta;  ///< interior ior / exterior ior, not 1
  Vec3<F> reflectance, transmittance;

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Pair pair = facet_between(wo, wi);
    const F fresnel = fresnel_dielectric(clamp_to_unit(pair.cos_wo), pair.eta_path).reflectance;
    const F shape = facets.density(pair.m) * facets.shadowing_by_cos(wo) * facets.shadowing_by_cos(wi);
    const F reflected = 0.25f * fresnel * shape;
    const F refracted = (1 - fresnel) * shape * pair.cos_wo * pair.cos_wi / pair.squared_length;
    const Vec3<F> f = select(pair.reflects, reflectance * reflected, transmittance * refracted);
    return select(pair.possible, f, Vec3<F>(F(0.0f)));
  }

  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Pair pair = facet_between(wo, wi);
    const F fresnel = fresnel_dielectric(clamp_to_unit(pair.cos_wo), pair.eta_path).reflectance;
    const F reflected = fresnel / (4 * pair.cos_wi);
    const F refracted = (1 - fresnel) * pair.eta_path * pair.eta_path * pair.cos_wi / pair.squared_length;
    const F density = facets.pdf(upper(wo), pair.m) * select(pair.reflects, reflected, refracted);
    return select(pair.possible, density, F(0.0f));
  }

  BsdfSample<F> sample(const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode mode) const {
    const Mask<F> outside = wo.z > 0;
    const F eta_path = select(outside, eta, 1 / eta), to_path = 1 / eta_path;
    const Vec3<F> wo_up = upper(wo);
    const Vec3<F> m = facets.sample(wo_up, u);
    const F cos_wo = dot(wo_up, m);
    const DielectricFresnel<F> fresnel = fresnel_dielectric(clamp_to_unit(cos_wo), eta_path);
    const Mask<F> reflects = u_lobe < fresnel.reflectance;
    const Vec3<F> refracted = advance(Vec3<F>(-wo_up * to_path), F(cos_wo * to_path - fresnel.cos_transmit), m);
    const Vec3<F> wi_up = select(reflects, mirrored(wo_up, m), refracted);
    const Vec3<F> wi = select(outside, wi_up, -wi_up);

    const F scale = mode == TransportMode::radiance ? F(to_path * to_path) : F(1.0f);
    const F shape = facets.shadowing_by_cos(wo) * facets.shadowing(wi) * facets.sampling_ratio(wo_up, m);
    // Squared length of the half vector wo + eta wi over its projection.
    const F along = cos_wo - eta_path * fresnel.cos_transmit;
    const F per_direction = select(reflects, F(fresnel.reflectance / (4 * cos_wo)),
                                   F((1 - fresnel.reflectance) * eta_path * eta_path * fresnel.cos_transmit /
                                     lane_max(F(along * along), F(1e-30f))));
    const F density = facets.pdf(wo_up, m) * per_direction;
    const Mask<F> right_side = select(reflects, wi_up.z, F(-wi_up.z)) > 0;
    return {wi,
            select(reflects, reflectance * shape, transmittance * F(shape * scale)),
            density,
            select(reflects, F(1.0f), eta_path),
            as_mask<F>(false),
            wo.z != 0 && cos_wo > 0 && density > 0 && right_side};
  }

 private:
  /// The facet that turns one direction into the other, with its cosines.
  struct Pair {
    Vec3<F> m;
    F eta_path;        ///< ior on wi's side / ior on wo's side
    F cos_wo, cos_wi;  ///< cosines of wo and wi to m, positive where possible
    F squared_length;  ///< squared length of wo + eta_path wi
    Mask<F> reflects, possible;
  };

  static Vec3<F> upper(const Vec3<F>& v) { return select(v.z > 0, v, -v); }

  Pair facet_between(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Mask<F> reflects = wo.z * wi.z > 0;
    const F eta_path = select(wo.z > 0, eta, 1 / eta);
    const Vec3<F> sum = advance(wo, select(reflects, F(1.0f), eta_path), wi);
    const F squared_length = lane_max(dot(sum, sum), F(1e-30f));
    const F turn = lane_copysign(F(1 / lane_sqrt(squared_length)), sum.z);
    const Vec3<F> m = sum * turn;
    const F cos_wo = lane_copysign(F(1.0f), wo.z) * dot(wo, m), cos_wi = lane_copysign(F(1.0f), wi.z) * dot(wi, m);
    return {m, eta_path, cos_wo, cos_wi, squared_length, reflects, cos_wo > 0 && cos_wi > 0 && wo.z * wi.z != 0};
  }
};

}  // namespace photonproof::inline renderer_bsdfs
