// A clear or tinted lacquer over an opaque base, one-sided (Weidlich and Wilkie 2007, "Arbitrarily Layered Micro-Facet
// Surfaces"). A smooth dielectric interface reflects; each crossing of the lacquer absorbs exp(-sigma_a thickness /
// cos). With wo', wi' the refracted directions, T the interface's transmittance and a the absorption along both,
//   `f = F mirror + T(wo) T(wi) / eta^2 a f_base(wo', wi') (light reflected between base and interface)`.
// The last factor makes the model conserve energy. R is the share that the interface returns through the lacquer.
//   Diffuse part    `1 / (1 - rho R)`, exact.
//   Mirror          `1 / (1 - rho F a)`, exact: each round leaves in the same direction.
//   Glossy part     `1 / (1 - rho min(F(wo), F(wi)) a)`, symmetric and never above the exact factor.
//                   It becomes exact as the base becomes a mirror.
// The record divides a metal's eta and k by the lacquer's index: lacquered metal is darker.
// Light that the interface reflects from one part of a two-part base to the other part is lost.
#pragma once

#include "renderer/bsdfs/bsdf_conductor.h"
#include "renderer/bsdfs/bsdf_diffuse.h"
#include "renderer/bsdfs/bsdf_phong.h"
#include "renderer/bsdfs/bsdf_plastic.h"
#include "renderer/bsdfs/bsdf_roughconductor.h"
#include "renderer/bsdfs/rough_part.h"

namespace photonproof::inline renderer_bsdfs {

/// Layered needs of a base its diffuse reflectance, its mirror reflectance at a cosine, and the rest as the BSDF
/// `glossy`. `glossy_reflectance` stands for the reflectance of that rest. Layered never reads parts that a base lacks.
template <class Base>
struct LayeredBase;

template <class F>
struct LayeredBase<DiffuseBsdf<F>> {
  static constexpr bool has_diffuse = true, has_mirror = false, has_glossy = false;
  static Vec3<F> diffuse(const DiffuseBsdf<F>& base) { return base.reflectance; }
};
template <class F>
struct LayeredBase<ConductorBsdf<F>> {
  static constexpr bool has_diffuse = false, has_mirror = true, has_glossy = false;
  static Vec3<F> mirror(const ConductorBsdf<F>& base, const F& cos_theta) {
    return select(base.has_ior > 0, base.reflectance * fresnel_conductor(cos_theta, base.eta, base.k),
                  base.reflectance);
  }
};
template <class F>
struct LayeredBase<RoughConductorBsdf<F>> {
  static constexpr bool has_diffuse = false, has_mirror = false, has_glossy = true;
  static const RoughConductorBsdf<F>& glossy(const RoughConductorBsdf<F>& base) { return base; }
  static Mask<F> glossy_is_rough(const RoughConductorBsdf<F>& base, const RoughLimit& limit) {
    return base.is_all_rough(limit);
  }
  static Vec3<F> glossy_reflectance(const RoughConductorBsdf<F>& base, const Vec3<F>& wo, const Vec3<F>& wi) {
    return base.facet_reflectance(clamp_to_unit(dot(wo, half_vector(wo, wi))));
  }
};
template <class F>
struct LayeredBase<PhongBsdf<F>> {
  static constexpr bool has_diffuse = true, has_mirror = false, has_glossy = true;
  static Vec3<F> diffuse(const PhongBsdf<F>& base) { return base.diffuse(); }
  static PhongBsdf<F> glossy(const PhongBsdf<F>& base) {
    return {base.raw_exponent, Vec3<F>(F(0.0f)), base.specular()};
  }
  static Mask<F> glossy_is_rough(const PhongBsdf<F>& base, const RoughLimit& limit) { return base.is_all_rough(limit); }
  static Vec3<F> glossy_reflectance(const PhongBsdf<F>& base, const Vec3<F>&, const Vec3<F>&) {
    return base.specular();
  }
};

template <class F, template <class> class Base>
struct LayeredBsdf {
  using Parts = LayeredBase<Base<F>>;
  static constexpr bool has_smooth = Parts::has_diffuse || Parts::has_glossy;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = false;
  Base<F> base;         ///< First, so that its words have the same offsets as without a lacquer.
  F eta;                ///< Ior of the lacquer / ior above it.
  Vec3<F> depth;        ///< The product sigma_a x thickness.
  Vec3<F> lost_inside;  ///< Share of the base's diffuse light that lacquer and interface do not send back.
  Vec3<F> specular;     ///< Factor of the interface's mirror.

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    if constexpr (!has_smooth) return Vec3<F>(F(0.0f));
    const Crossing o = crossing(wo), i = crossing(wi);
    const Vec3<F> way = o.absorbed * i.absorbed;
    Vec3<F> f(F(0.0f));
    if constexpr (Parts::has_diffuse) f = diffuse_reflectance() * F(1 / pi);
    if constexpr (Parts::has_glossy) f += glossy_part(o, i);
    f = f * way * F(o.through * i.through / (eta * eta));
    return select(wo.z > 0 && wi.z > 0, f, Vec3<F>(F(0.0f)));
  }

  /// A diffuse base is always rough.
  Mask<F> is_rough(const RoughLimit& limit) const requires has_smooth {
    if constexpr (Parts::has_diffuse) return as_mask<F>(true);
    if constexpr (Parts::has_glossy) return Parts::glossy_is_rough(base, limit);
  }
  Vec3<F> rough_share(const RoughLimit& limit, const Vec3<F>& wo, const Vec3<F>& wi) const requires has_smooth {
    const Vec3<F> one(F(1.0f));
    if constexpr (Parts::has_glossy) {
      const Mask<F> rough = Parts::glossy_is_rough(base, limit);
      if constexpr (!Parts::has_diffuse) return select(rough, one, Vec3<F>(F(0.0f)));
      if (all(rough)) return one;
      Vec3<F> diffuse_part(F(0.0f));
      if constexpr (Parts::has_diffuse) diffuse_part = diffuse_reflectance() * F(1 / pi);
      return select(rough, one,
                    share_of<F>(diffuse_part, Vec3<F>(diffuse_part + glossy_part(crossing(wo), crossing(wi)))));
    }
    return one;
  }

  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Choice choice = lobes(crossing(wo));
    return select(wo.z > 0 && wi.z > 0, smooth_pdf(choice, wo, wi), F(0.0f));
  }

  BsdfSample<F> sample(const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode mode) const {
    const Crossing o = crossing(wo);
    const Choice choice = lobes(o);
    const Mask<F> mirrors = u_lobe < choice.mirror;
    Vec3<F> wi(F(0.0f), F(0.0f), F(1.0f));
    if constexpr (Parts::has_diffuse) wi = square_to_cosine_hemisphere(u);
    if constexpr (Parts::has_glossy) {
      const BsdfSample<F> below = Parts::glossy(base).sample(o.inside, F(0.0f), u, mode);
      const F sin2 = (1 - below.wi_local.z * below.wi_local.z) * eta * eta;
      const Mask<F> leaves = below.valid && sin2 < 1;
      const Vec3<F> out(below.wi_local.x * eta, below.wi_local.y * eta,
                        select(leaves, lane_sqrt(lane_max(F(1 - sin2), F(0.0f))), F(-1.0f)));
      wi = select(u_lobe < choice.mirror + choice.glossy, out, wi);
    }
    wi = select(mirrors, Vec3<F>(-wo.x, -wo.y, wo.z), wi);
    Vec3<F> weight = choice.mirror_reflectance * F(1 / choice.mirror);
    F density = choice.mirror;
    if constexpr (has_smooth) {
      density = select(mirrors, density, smooth_pdf(choice, wo, wi));
      weight = select(mirrors, weight, eval(wo, wi) * F(wi.z / density));
    }
    return {wi, weight, density, F(1.0f), mirrors, wo.z > 0 && wi.z > 0 && density > 0};
  }

 private:
  /// One crossing of interface and lacquer.
  struct Crossing {
    Vec3<F> inside;    ///< the refracted direction, still pointing up
    F through;         ///< transmittance of the interface
    Vec3<F> absorbed;  ///< share of the light that the lacquer transmits
  };
  Crossing crossing(const Vec3<F>& v) const {
    const DielectricFresnel<F> fresnel = fresnel_dielectric(clamp_to_unit(v.z), eta);
    const F to_inside = 1 / eta, per_cos = -1 / lane_max(fresnel.cos_transmit, F(1e-6f));
    return {{v.x * to_inside, v.y * to_inside, fresnel.cos_transmit},
            1 - fresnel.reflectance,
            {lane_exp(F(depth.x * per_cos)), lane_exp(F(depth.y * per_cos)), lane_exp(F(depth.z * per_cos))}};
  }

  /// Reflection f of the base's glossy part, without the lacquer's absorption and the interface's crossings.
  Vec3<F> glossy_part(const Crossing& o, const Crossing& i) const {
    const Vec3<F> rho = Parts::glossy_reflectance(base, o.inside, i.inside);
    const F back = lane_min(F(1 - o.through), F(1 - i.through));
    return Parts::glossy(base).eval(o.inside, i.inside) / (Vec3<F>(F(1.0f)) - rho * (o.absorbed * i.absorbed) * back);
  }

  Vec3<F> diffuse_reflectance() const { return between_reflections(Parts::diffuse(base), lost_inside); }

  /// Probabilities of the lobes, roughly in proportion to the light that each reflects; the diffuse one has the rest.
  struct Choice {
    F mirror, glossy;
    Vec3<F> mirror_reflectance;
  };
  Choice lobes(const Crossing& o) const {
    const F fresnel = 1 - o.through;
    const Vec3<F> way = o.absorbed * o.absorbed;
    Vec3<F> mirror = specular * fresnel;
    if constexpr (Parts::has_mirror) {
      const Vec3<F> below = Parts::mirror(base, o.inside.z) * way;
      mirror += below * F(o.through * o.through) / (Vec3<F>(F(1.0f)) - below * fresnel);
    }
    F glossy(0.0f), diffuse(0.0f);
    if constexpr (Parts::has_glossy)
      glossy =
          o.through * mean_channel(Vec3<F>(way * Parts::glossy_reflectance(base, o.inside, mirrored_up(o.inside))));
    if constexpr (Parts::has_diffuse)
      diffuse = o.through * mean_channel(Vec3<F>(o.absorbed * diffuse_reflectance())) * (1 / (eta * eta));
    const F all_lobes = mean_channel(mirror) + glossy + diffuse;
    const F scale = select(all_lobes > 0, F(1 / all_lobes), F(0.0f));
    if constexpr (!has_smooth) return {F(1.0f), F(0.0f), mirror};
    if constexpr (!Parts::has_diffuse) return {mean_channel(mirror) * scale, 1 - mean_channel(mirror) * scale, mirror};
    return {mean_channel(mirror) * scale, glossy * scale, mirror};
  }
  static Vec3<F> mirrored_up(const Vec3<F>& v) { return {-v.x, -v.y, v.z}; }

  F smooth_pdf(const Choice& choice, const Vec3<F>& wo, const Vec3<F>& wi) const {
    F density(0.0f);
    if constexpr (Parts::has_diffuse) density = (1 - choice.mirror - choice.glossy) * cosine_hemisphere_pdf(wi.z);
    if constexpr (Parts::has_glossy) {
      const Vec3<F> o = crossing(wo).inside, i = crossing(wi).inside;
      // d(wi') = d(wi) cos / (eta^2 cos')
      density += choice.glossy * Parts::glossy(base).pdf(o, i) * wi.z / (eta * eta * lane_max(i.z, F(1e-6f)));
    }
    return density;
  }
};

template <class F>
using LayeredDiffuseBsdf = LayeredBsdf<F, DiffuseBsdf>;
template <class F>
using LayeredConductorBsdf = LayeredBsdf<F, ConductorBsdf>;
template <class F>
using LayeredRoughConductorBsdf = LayeredBsdf<F, RoughConductorBsdf>;
template <class F>
using LayeredPhongBsdf = LayeredBsdf<F, PhongBsdf>;

}  // namespace photonproof::inline renderer_bsdfs
