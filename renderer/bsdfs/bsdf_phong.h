// Modified Phong reflection, one-sided, as in Mitsuba 0.6 (Lafortune and Willems 1994, "Using the Modified Phong
// Reflectance Model for Physically Based Rendering").
//   `f = diffuse / pi + specular (n + 2) / (2 pi) cos^n(angle to the mirror direction)`.
// Colours whose sum exceeds 1 are scaled down to 1 in the strongest channel.
#pragma once

#include "renderer/bsdfs/bsdf_plastic.h"
#include "renderer/bsdfs/rough_part.h"
#include "renderer/lanes/lane_exp.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct PhongBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = false;
  F raw_exponent;
  Vec3<F> raw_diffuse, raw_specular;

  F exponent() const { return lane_min(lane_max(raw_exponent, F(0.0f)), F(1e7f)); }
  Vec3<F> diffuse() const { return raw_diffuse * scale(); }
  Vec3<F> specular() const { return raw_specular * scale(); }

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F n = exponent();
    const F lobe = (n + 2) * (0.5f / pi) * power_of_cos(wo, wi, n);
    return select(wo.z > 0 && wi.z > 0, Vec3<F>((raw_diffuse * F(1 / pi) + raw_specular * lobe) * scale()),
                  Vec3<F>(F(0.0f)));
  }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F n = exponent(), p = gloss_probability();
    const F lobe = (n + 1) * (0.5f / pi) * power_of_cos(wo, wi, n);
    return select(wo.z > 0 && wi.z > 0, F(p * lobe + (1 - p) * cosine_hemisphere_pdf(wi.z)), F(0.0f));
  }
  Mask<F> is_all_rough(const RoughLimit& limit) const { return exponent() <= limit.most_exponent; }
  /// The diffuse part is always rough.
  Mask<F> is_rough(const RoughLimit&) const { return as_mask<F>(true); }
  Vec3<F> rough_share(const RoughLimit& limit, const Vec3<F>& wo, const Vec3<F>& wi) const {
    if (all(is_all_rough(limit))) return Vec3<F>(F(1.0f));
    const F n = exponent();
    const Vec3<F> diffuse_part = raw_diffuse * F(1 / pi);
    const Vec3<F> lobe = raw_specular * F((n + 2) * (0.5f / pi) * power_of_cos(wo, wi, n));
    return select(is_all_rough(limit), Vec3<F>(F(1.0f)), share_of<F>(diffuse_part, Vec3<F>(diffuse_part + lobe)));
  }
  BsdfSample<F> sample(const Vec3<F>& wo, const F& u_lobe, const Vec2<F>& u, TransportMode) const {
    const F n = exponent();
    const F log_cos2 = 2 * lane_log(F(1 - u.x)) / (n + 1);
    const F cos2 = lane_exp(log_cos2);
    // 1 - cos^2 would lose the narrow lobes of large exponents.
    const F sin2 =
        select(log_cos2 > -0.01f, F(-log_cos2 * mul_add(log_cos2, mul_add(log_cos2, F(1.0f / 6), F(0.5f)), F(1.0f))),
               F(1 - cos2));
    const F cos_lobe = lane_sqrt(cos2), sin_lobe = lane_sqrt(lane_max(sin2, F(0.0f)));
    const SinCos<F> phi = sincos_turn(u.y);
    const Frame<F> around(Vec3<F>(-wo.x, -wo.y, wo.z));
    const Vec3<F> glossy = around.to_world(Vec3<F>(sin_lobe * phi.cos, sin_lobe * phi.sin, cos_lobe));
    const Vec3<F> wi = select(u_lobe < gloss_probability(), glossy, square_to_cosine_hemisphere(u));
    const F density = pdf(wo, wi);
    return {wi, eval(wo, wi) * F(wi.z / density), density, F(1.0f), as_mask<F>(false), density > 0};
  }

 private:
  /// cos^n of wi's angle to the mirror direction, computed from the distance d of their tips as cos = 1 - d^2/2. Near 1
  /// this has more digits than the cosine itself.
  static F power_of_cos(const Vec3<F>& wo, const Vec3<F>& wi, const F& n) {
    const Vec3<F> apart(wi.x + wo.x, wi.y + wo.y, wi.z - wo.z);
    const F e = 0.5f * dot(apart, apart);
    const F log_cos =
        select(e < 0.01f, F(-e * mul_add(e, mul_add(e, mul_add(e, F(0.25f), F(1.0f / 3)), F(0.5f)), F(1.0f))),
               lane_log(lane_max(F(1 - e), F(0.0f))));
    return select(e < 1, lane_exp(F(n * log_cos)), F(0.0f));
  }
  F scale() const { return 1 / lane_max(max_component(Vec3<F>(raw_diffuse + raw_specular)), F(1.0f)); }
  F gloss_probability() const { return lobe_probability(mean_channel(raw_specular), mean_channel(raw_diffuse)); }
};

}  // namespace photonproof::inline renderer_bsdfs
