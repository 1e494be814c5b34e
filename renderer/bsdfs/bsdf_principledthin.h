// Burley's principled BSDF of a sheet without thickness (Burley 2015, section 5.3), with the meaning of Mitsuba 3's
// `principledthin`. It is the same from both sides and a sum of lobes:
//   glass, on the share spec_trans: GGX facets reflect, and the light that they let through leaves as if reflected, on
//   the other side. Refraction at both faces narrows that lobe by the factor 0.65 eta - 0.35 in roughness;
//   the base (principled_parts.h), on the rest. The share diff_trans / 2 of it passes and is Lambertian.
// Mitsuba lets light pass glass only where the light meets the back of the facet that passes it on. That depends on
// which direction is the viewer's, so swapped directions have another value there. The density here ignores it.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/principled_parts.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct PrincipledThinBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = true;
  PrincipledBase<F> base;
  F anisotropic, spec_trans, spec_tint;
  F raw_eta;     ///< index of the sheet / index around it, as given by the scene or a texture
  F diff_trans;  ///< 0 to 2
  F diffuse_rate, specular_rate, transmitted_rate, diffuse_transmitted_rate;  ///< weights of the lobes in sampling

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Folded at = folded(wo, wi);
    const F through = 0.5f * diff_trans;
    const Vec3<F> passed = base.colour * F(through * (1 / pi));
    Vec3<F> f = select(at.reflects, Vec3<F>(diffuse(at) * F(1 - through)), passed) * F(1 - spec_trans);
    if (any(spec_trans > 0)) {
      const FacetFresnel<F> fresnel(at.cos_half, eta());
      const F shape = facets(at.reflects).shape(at);
      const Vec3<F> reflected = highlight(fresnel) * shape;
      const Mask<F> meets_back = at.m.z * at.wi.z > mul_add(at.m.x, at.wi.x, F(at.m.y * at.wi.y));
      const F transmitted = (1 - fresnel.dielectric) * select(meets_back, shape, F(0.0f));
      const Vec3<F> refracted = base.colour * transmitted;
      f += select(at.reflects, reflected, refracted) * spec_trans;
    }
    return select(at.possible, f, Vec3<F>(F(0.0f)));
  }

  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Folded at = folded(wo, wi);
    const Lobes lobes = choice();
    F density = select(at.reflects, lobes.diffuse, lobes.diffuse_transmitted) * cosine_hemisphere_pdf(at.wi.z);
    if (any(spec_trans > 0))
      density += select(at.reflects, lobes.specular, lobes.transmitted) * facets(at.reflects).pdf(at.wo, at.m) * 0.25f /
                 at.cos_half;
    return select(at.possible, density, F(0.0f));
  }

  BsdfSample<F> sample(const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode mode) const {
    const Lobes lobes = choice();
    const F both = lobes.specular + lobes.transmitted;
    const Mask<F> facet = u_lobe < both;
    const Mask<F> reflects = u_lobe < lobes.specular || (!facet && u_lobe < both + lobes.diffuse);
    const Vec3<F> wo_up = select(wo.z > 0, wo, -wo);
    Vec3<F> up = square_to_cosine_hemisphere(u);
    if (any(facet)) up = select(facet, mirrored(wo_up, facets(reflects).sample(wo_up, u)), up);
    const Mask<F> above = up.z > 0;
    up.z = select(reflects, up.z, F(-up.z));
    const Vec3<F> wi = select(wo.z > 0, up, Vec3<F>(-up));
    const F density = pdf(wo, wi);
    const Vec3<F> f = mode == TransportMode::radiance ? eval(wo, wi) : eval(wi, wo);
    return {
        wi, f * F(lane_abs(wi.z) / density), density, F(1.0f), as_mask<F>(false), wo.z != 0 && above && density > 0};
  }

  /// Light that is reflected in front is gathered where the lobe is wide, the rest is traced.
  Mask<F> is_rough(const RoughLimit& limit) const {
    return spec_trans < 1 || facets(as_mask<F>(true)).are_rough(limit);
  }
  Vec3<F> rough_share(const RoughLimit& limit, const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Vec3<F> none(F(0.0f));
    const Mask<F> in_front = wo.z > 0 && wi.z > 0;
    if (!any(in_front)) return none;
    const Folded at = folded(wo, wi);
    const Facets main = facets(as_mask<F>(true));
    const Vec3<F> below = diffuse(at) * F((1 - spec_trans) * (1 - 0.5f * diff_trans));
    const Vec3<F> glossy = highlight(FacetFresnel<F>(at.cos_half, eta())) * F(spec_trans * main.shape(at));
    const Vec3<F> rough = select(main.are_rough(limit), Vec3<F>(below + glossy), below);
    return select(in_front, share_of<F>(rough, Vec3<F>(below + glossy)), none);
  }

 private:
  /// Both directions turned to the side of the normal.
  struct Folded {
    Vec3<F> wo, wi, m;
    F cos_half;
    Mask<F> reflects, possible;
  };
  static Folded folded(const Vec3<F>& wo, const Vec3<F>& wi) {
    const Vec3<F> wo_up = select(wo.z > 0, wo, -wo);
    Vec3<F> wi_up = select(wo.z > 0, wi, Vec3<F>(-wi));
    const Mask<F> reflects = wi_up.z > 0;
    wi_up.z = lane_abs(wi_up.z);
    const Vec3<F> m = half_vector(wo_up, wi_up);
    const F cos_half = dot(wo_up, m);
    return {wo_up, wi_up, m, cos_half, reflects, wo.z * wi.z != 0 && cos_half > 0};
  }

  struct Facets : Microfacets<F> {
    explicit Facets(const Microfacets<F>& facets) : Microfacets<F>(facets) {}
    F shape(const Folded& at) const {
      return 0.25f * this->density(at.m) * this->shadowing_by_cos(at.wo) * this->shadowing_by_cos(at.wi);
    }
  };
  /// The facets by which light is reflected or passes.
  Facets facets(const Mask<F>& reflects) const {
    const F narrowing = select(reflects, F(1.0f), mul_add(F(0.65f), eta(), F(-0.35f)));
    return Facets(principled_facets(F(narrowing * base.roughness), anisotropic));
  }
  F eta() const { return lane_max(raw_eta, F(1e-3f)); }

  Vec3<F> highlight(const FacetFresnel<F>& fresnel) const {
    Vec3<F> reflectance(fresnel.dielectric);
    if (any(spec_tint > 0)) reflectance = mixed(reflectance, fresnel.tinted(base.colour, eta()), spec_tint);
    return reflectance;
  }
  Vec3<F> diffuse(const Folded& at) const {
    Vec3<F> f = base.diffuse(at.wo.z, at.wi.z, at.cos_half);
    if (any(base.sheen > 0)) f += base.cloth(at.cos_half);
    return f;
  }

  /// Probabilities of the lobes.
  struct Lobes {
    F specular, transmitted, diffuse, diffuse_transmitted;
  };
  Lobes choice() const {
    const F through = 0.5f * diff_trans, other = 1 - spec_trans;
    const F specular = 0.5f * spec_trans * specular_rate, transmitted = 0.5f * spec_trans * transmitted_rate;
    const F diffuse = other * (1 - through) * diffuse_rate, passed = other * through * diffuse_transmitted_rate;
    const F scale = 1 / lane_max(F(specular + transmitted + diffuse + passed), F(1e-30f));
    return {specular * scale, transmitted * scale, diffuse * scale, passed * scale};
  }
};

}  // namespace photonproof::inline renderer_bsdfs
