// Parts of both principled BSDFs, as in Mitsuba 3. Directions are local and above the surface.
// Burley 2012, "Physically Based Shading at Disney". Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated
// Subsurface Scattering".
#pragma once

#include "renderer/bsdfs/fresnel.h"
#include "renderer/bsdfs/microfacet.h"
#include "renderer/bsdfs/rough_part.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
Vec3<F> mixed(const Vec3<F>& a, const Vec3<F>& b, const F& share_of_b) {
  return a * F(1 - share_of_b) + b * share_of_b;
}

/// Schlick's (1 - cos)^5.
template <class F>
F schlick_weight(const F& cosine) {
  const F x = clamp_to_unit(F(1 - cosine)), x2 = x * x;
  return x2 * x2 * x;
}

/// The colour divided by its luminance; white where it is black.
template <class F>
Vec3<F> hue(const Vec3<F>& colour) {
  const F luminance = 0.212671f * colour.x + 0.715160f * colour.y + 0.072169f * colour.z;
  const Mask<F> lit = luminance > 0;
  return select(lit, Vec3<F>(colour * F(1 / select(lit, luminance, F(1.0f)))), Vec3<F>(F(1.0f)));
}

/// GGX facets of this roughness. The area of a highlight, alpha_u alpha_v, does not depend on `anisotropic`.
template <class F>
Microfacets<F> principled_facets(const F& roughness, const F& anisotropic) {
  const F alpha = roughness * roughness, aspect = lane_sqrt(F(1 - 0.9f * anisotropic));
  return {lane_max(F(alpha / aspect), F(1e-3f)), lane_max(F(alpha * aspect), F(1e-3f)), F(1.0f), F(1.0f)};
}

/// A facet's reflection at an interface of index `eta`, for light and viewer at this cosine to its normal.
template <class F>
struct FacetFresnel {
  F dielectric;  ///< exact
  F weight;      ///< Schlick's weight. On the way into a thinner medium it takes the angle of the refracted ray.

  FacetFresnel(const F& cosine, const F& eta) {
    const DielectricFresnel<F> exact = fresnel_dielectric(clamp_to_unit(cosine), eta);
    dielectric = select(eta == 1.0f, F(0.0f), exact.reflectance);
    weight = schlick_weight<F>(select(eta > 1, cosine, exact.cos_transmit));
  }
  Vec3<F> schlick(const Vec3<F>& at_normal) const { return mixed(at_normal, Vec3<F>(F(1.0f)), weight); }
  /// Schlick's approximation with the hue of this colour.
  Vec3<F> tinted(const Vec3<F>& colour, const F& eta) const {
    const F root = (eta - 1) / (eta + 1);
    return schlick(hue(colour) * F(root * root));
  }
};

/// The base's reflection.
template <class F>
struct PrincipledBase {
  Vec3<F> colour;
  F roughness, flatness, sheen, sheen_tint;

  /// Value f without the share of light that the base gets. `cos_half` is the cosine of both directions to their half.
  Vec3<F> diffuse(const F& cos_o, const F& cos_i, const F& cos_half) const {
    const F at_o = schlick_weight(cos_o), at_i = schlick_weight(cos_i);
    const F grazing = 2 * roughness * cos_half * cos_half;
    const F falloff = (1 - 0.5f * at_o) * (1 - 0.5f * at_i);
    const F retro = grazing * (at_o + at_i + at_o * at_i * (grazing - 1));
    F f = falloff + retro;
    if (any(flatness > 0)) {  // after Hanrahan and Krueger 1993
      const F flat = 0.5f * grazing - 1;
      const F slab = (1 + at_o * flat) * (1 + at_i * flat);
      const F scattered = 1.25f * (slab * (1 / lane_max(F(cos_o + cos_i), F(1e-20f)) - 0.5f) + 0.5f);
      f = f + flatness * (scattered - f);
    }
    return colour * F(f * (1 / pi));
  }
  Vec3<F> cloth(const F& cos_half) const {
    return mixed(Vec3<F>(F(1.0f)), hue(colour), sheen_tint) * F(sheen * schlick_weight(cos_half));
  }
};

/// The clear coat's facets: generalised Trowbridge-Reitz of exponent 1 (Burley 2012, appendix B).
template <class F>
struct CoatFacets {
  F alpha;

  explicit CoatFacets(const F& gloss) : alpha(mul_add(gloss, F(-0.099f), F(0.1f))) {}

  F density(const Vec3<F>& m) const {
    const F a2 = alpha * alpha, sin2 = mul_add(m.x, m.x, F(m.y * m.y));
    return (a2 - 1) / (pi * lane_log(a2) * lane_max(mul_add(a2, F(m.z * m.z), sin2), F(1e-30f)));
  }
  /// Density of `sample`.
  F pdf(const Vec3<F>& m) const { return density(m) * lane_max(m.z, F(0.0f)); }
  Vec3<F> sample(const Vec2<F>& u) const {
    const F a2 = alpha * alpha;
    const F sin2 = clamp_to_unit(F((lane_exp(F(lane_log(a2) * (1 - u.y))) - a2) / (1 - a2)));
    const F sine = lane_sqrt(sin2);
    const SinCos<F> phi = sincos_turn(u.x);
    return {sine * phi.cos, sine * phi.sin, lane_sqrt(F(1 - sin2))};
  }
  /// Burley's shadowing has a fixed width. Over |v.z|.
  static F shadowing_by_cos(const Vec3<F>& v) {
    const F z = lane_max(lane_abs(v.z), F(1e-20f)), across2 = mul_add(v.x, v.x, F(v.y * v.y));
    return 2 / (z + lane_sqrt(mul_add(z, z, F(0.0625f * across2))));
  }
};

}  // namespace photonproof::inline renderer_bsdfs
