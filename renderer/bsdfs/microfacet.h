// Rough interfaces as distributions of small mirrors ("microfacets"): Beckmann's and the GGX distribution, anisotropic,
// with Smith's shadowing (Walter, Marschner, Li and Torrance 2007; Heitz 2014, "Understanding the Masking-Shadowing
// Function"). Directions are local, z up; a facet's normal m has m.z > 0. Densities are per solid angle of m.
#pragma once

#include "renderer/bsdfs/rough_part.h"
#include "renderer/lanes/lane_exp.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct Microfacets {
  F raw_alpha_u, raw_alpha_v;  ///< Roughness along x and y as given by the scene or a texture.
  F is_ggx;                    ///< Either 1 or 0.
  F sample_visible;            ///< 1: `sample` gives normals visible from wo; 0: normals by area, as from above.

  /// Below alpha 1e-4 the facets are a mirror in single precision.
  static F usable(const F& alpha) { return lane_min(lane_max(alpha, F(1e-4f)), F(1e4f)); }
  F alpha_u() const { return usable(raw_alpha_u); }
  F alpha_v() const { return usable(raw_alpha_v); }
  Mask<F> are_rough(const RoughLimit& limit) const { return lane_min(raw_alpha_u, raw_alpha_v) >= limit.least_alpha; }

  /// Area of facets with normal m per solid angle and per area of the surface.
  F density(const Vec3<F>& m) const {
    const F au = alpha_u(), av = alpha_v();
    const F x = m.x / au, y = m.y / av;
    const F radial2 = mul_add(x, x, F(y * y)), z2 = lane_max(F(m.z * m.z), F(1e-12f));
    const F scale = (1 / pi) / (au * av);
    const Mask<F> ggx = is_ggx > 0;
    F d(0.0f);
    if (any(ggx)) {
      const F sum = radial2 + z2;
      d = scale / (sum * sum);
    }
    if (!all(ggx)) d = select(ggx, d, F(scale * lane_exp(F(-radial2 / z2)) / (z2 * z2)));
    return select(m.z > 0, d, F(0.0f));
  }

  /// The share of the facets facing v that v sees, from either side, over |v.z|. Beckmann's is the rational
  /// approximation of Walter et al., within 0.35 %, because Mitsuba uses it; `visible_density` has the exact one.
  F shadowing_by_cos(const Vec3<F>& v) const {
    const F z = lane_max(lane_abs(v.z), F(1e-20f)), spread = lane_max(stretch(v), F(1e-20f));
    const Mask<F> ggx = is_ggx > 0;
    F g(0.0f);
    if (any(ggx)) g = 2 / (z + lane_sqrt(F(z * z + spread * spread)));
    if (!all(ggx)) {
      const F a = lane_min(F(z / spread), F(1.6f));
      const F rational = mul_add(a, F(2.181f), F(3.535f)) / mul_add(a, mul_add(a, F(2.577f), F(2.276f)), F(1.0f));
      g = select(ggx, g, select(a < 1.6f, F(rational / spread), F(1 / z)));
    }
    return g;
  }
  F shadowing(const Vec3<F>& v) const { return lane_abs(v.z) * shadowing_by_cos(v); }

  /// Density of a normal among those that wo, above the surface, sees. It integrates to 1.
  F visible_density(const Vec3<F>& wo, const Vec3<F>& m) const {
    return density(m) * lane_max(dot(wo, m), F(0.0f)) / seen_area(wo);
  }

  /// Density of `sample`.
  F pdf(const Vec3<F>& wo, const Vec3<F>& m) const {
    const Mask<F> visible = sample_visible > 0;
    F p = density(m) * m.z;
    if (any(visible)) p = select(visible, visible_density(wo, m), p);
    return p;
  }

  /// Normal of a facet, sampled for wo above the surface.
  Vec3<F> sample(const Vec3<F>& wo, const Vec2<F>& u) const {
    const Mask<F> visible = sample_visible > 0, ggx = is_ggx > 0;
    Vec3<F> m(F(0.0f), F(0.0f), F(1.0f));
    if (any(visible && ggx)) m = sample_visible_ggx(wo, u);
    if (any(visible && !ggx)) m = select(visible && !ggx, sample_visible_beckmann(wo, u), m);
    if (!all(visible)) m = select(visible, m, sample_area(u));
    return m;
  }

  /// The ratio density(m) |wo.m| / density of `sample`. Times shadowing_by_cos(wo), shadowing(wi) and Fresnel's factor
  /// it is a sample's weight.
  F sampling_ratio(const Vec3<F>& wo, const Vec3<F>& m) const {
    return select(sample_visible > 0, seen_area(wo), F(lane_abs(dot(wo, m)) / m.z));
  }

 private:
  /// Roughness towards v times the sine of its angle.
  F stretch(const Vec3<F>& v) const {
    const F x = alpha_u() * v.x, y = alpha_v() * v.y;
    return lane_sqrt(mul_add(x, x, F(y * y)));
  }

  /// Area of the facets that face v, seen from v, per area of the surface: |v.z| (1 + Smith's Lambda).
  F seen_area(const Vec3<F>& v) const {
    const F z = lane_abs(v.z), spread = stretch(v);
    const Mask<F> ggx = is_ggx > 0;
    F area(0.0f);
    if (any(ggx)) area = 0.5f * (z + lane_sqrt(F(z * z + spread * spread)));
    if (!all(ggx)) {
      const F a = lane_min(F(z / lane_max(spread, F(1e-30f))), F(9.0f));
      const F tail = lane_exp(F(-a * a)) * (inverse_sqrt_pi - a * lane_erfcx(a));
      area = select(ggx, area, F(z + 0.5f * spread * lane_max(tail, F(0.0f))));
    }
    return area;
  }

  /// Normal sampled by area: the slopes of an isotropic surface of roughness 1, stretched.
  Vec3<F> sample_area(const Vec2<F>& u) const {
    const F left = 1 - u.x;
    const F slope2 = select(is_ggx > 0, F(u.x / left), -lane_log(left));
    const F slope = lane_sqrt(lane_max(slope2, F(0.0f)));
    const SinCos<F> phi = sincos_turn(u.y);
    return normalize(Vec3<F>(alpha_u() * slope * phi.cos, alpha_v() * slope * phi.sin, F(1.0f)));
  }

  /// Frame of the stretched direction's azimuth; x where the azimuth is undefined.
  static Vec2<F> azimuth(const Vec3<F>& stretched, const F& sin_theta) {
    const Mask<F> tilted = sin_theta > 0;
    const F inverse = 1 / select(tilted, sin_theta, F(1.0f));
    return {select(tilted, F(stretched.x * inverse), F(1.0f)), select(tilted, F(stretched.y * inverse), F(0.0f))};
  }

  /// Heitz 2018, "Sampling the GGX Distribution of Visible Normals".
  Vec3<F> sample_visible_ggx(const Vec3<F>& wo, const Vec2<F>& u) const {
    const F au = alpha_u(), av = alpha_v();
    const Vec3<F> v = normalize(Vec3<F>(au * wo.x, av * wo.y, lane_max(wo.z, F(1e-20f))));
    const F sin_theta = lane_sqrt(mul_add(v.x, v.x, F(v.y * v.y)));
    const Vec2<F> phi = azimuth(v, sin_theta);
    const Vec3<F> t1(-phi.y, phi.x, F(0.0f));
    const Vec3<F> t2(-v.z * phi.x, -v.z * phi.y, sin_theta);
    const Vec2<F> disc = square_to_disc(u);
    const F s = 0.5f * (1 + v.z);
    const F chord = lane_sqrt(lane_max(F(1 - disc.x * disc.x), F(0.0f)));
    const F y = mul_add(s, disc.y, F((1 - s) * chord));
    const F z = lane_sqrt(lane_max(F(1 - disc.x * disc.x - y * y), F(0.0f)));
    const Vec3<F> n = advance(advance(Vec3<F>(t1 * disc.x), y, t2), z, v);
    return normalize(Vec3<F>(au * n.x, av * n.y, lane_max(n.z, F(1e-6f))));
  }

  /// Heitz and d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals".
  /// Along the azimuth of the stretched direction, slopes x < cot have the density (1 - x tan) exp(-x^2) up to a
  /// factor. The distribution function is 1 + erf(x) + tan exp(-x^2)/sqrt(pi), up to the same factor. It is inverted in
  /// b = erf(x), where it is concave, so Newton steps from the left of the root stay there; a bracket catches the
  /// others. At grazing angles the first guess is exact (Jakob 2014).
  Vec3<F> sample_visible_beckmann(const Vec3<F>& wo, const Vec2<F>& u) const {
    const F au = alpha_u(), av = alpha_v();
    const Vec3<F> v = normalize(Vec3<F>(au * wo.x, av * wo.y, lane_max(wo.z, F(1e-20f))));
    const F sin_theta = lane_sqrt(mul_add(v.x, v.x, F(v.y * v.y)));
    const Vec2<F> phi = azimuth(v, sin_theta);
    const F tan_theta = sin_theta / v.z;
    const F cot = lane_min(F(v.z / lane_max(sin_theta, F(1e-20f))), F(9.0f));

    const F u_x = lane_min(lane_max(u.x, F(1e-6f)), F(1 - 1e-6f));
    const F b_end = lane_erf(cot);
    const F area = 1 + b_end + inverse_sqrt_pi * tan_theta * lane_exp(F(-cot * cot));
    F low(-1.0f), high = b_end;
    F b = b_end - (b_end + 1) * lane_erf(lane_sqrt(-lane_log(u_x)));
    for (int step = 0; step < 6; ++step) {
      b = select(b >= low && b <= high, b, F(0.5f * (low + high)));
      const F x = lane_erfinv(b);
      const F excess = 1 + b + inverse_sqrt_pi * tan_theta * lane_exp(F(-x * x)) - u_x * area;
      low = select(excess < 0, b, low);
      high = select(excess < 0, high, b);
      b = b - excess / (1 - x * tan_theta);
    }
    b = select(b >= low && b <= high, b, F(0.5f * (low + high)));
    const F along = lane_erfinv(b), across = lane_erfinv(F(2 * lane_max(u.y, F(0x1p-25f)) - 1));
    const F slope_x = phi.x * along - phi.y * across, slope_y = phi.y * along + phi.x * across;
    return normalize(Vec3<F>(-au * slope_x, -av * slope_y, F(1.0f)));
  }

  static constexpr float inverse_sqrt_pi = std::numbers::inv_sqrtpi_v<float>;
};

/// The normal that mirrors wo to wi; up for opposite directions, where any normal would do.
template <class F>
Vec3<F> half_vector(const Vec3<F>& wo, const Vec3<F>& wi) {
  const Vec3<F> sum = wo + wi;
  const F length2 = dot(sum, sum);
  const Mask<F> defined = length2 > 1e-30f;
  const F scale = 1 / lane_sqrt(select(defined, length2, F(1.0f)));
  return select(defined, Vec3<F>(sum * scale), Vec3<F>(F(0.0f), F(0.0f), F(1.0f)));
}

/// v mirrored about m.
template <class F>
Vec3<F> mirrored(const Vec3<F>& v, const Vec3<F>& m) {
  return advance(Vec3<F>(-v), F(2 * dot(v, m)), m);
}

}  // namespace photonproof::inline renderer_bsdfs
