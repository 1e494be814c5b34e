// The rough part of a BSDF. Photons are gathered for it, since a ray sampled from it would hit a small light too
// rarely. The rest, mirrors and sharp highlights, is traced. Kinds that can have a rough part define:
//   `is_rough(limit)`: lanes where the rough part is not 0.
//   `rough_share(limit, wo, wi)`: its share of eval, a channel each, in [0,1].
//   `is_all_rough(limit)`: lanes without a mirror and sharp highlights. Kinds that always have one omit it.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_bsdfs {

/// Where roughness begins: microfacets' alpha along the sharper direction. Phong's exponent is that of equally wide
/// lobes, alpha^2 = 2 / (exponent + 2) (Walter et al. 2007).
struct RoughLimit {
  float least_alpha = 0.2f, most_exponent = 48;
};
/// Limit for scenes with lights that no ray can hit: light that photons do not bring there is lost.
inline constexpr RoughLimit rough_limit_of_points{0.05f, 800};

template <class Kind, class F>
concept CanBeRough = requires(const Kind& bsdf, const RoughLimit& limit, const Vec3<F>& w) {
  bsdf.is_rough(limit);
  bsdf.rough_share(limit, w, w);
};

/// Ratio `some` / `all`, 0 where `all` is 0.
template <class F>
Vec3<F> share_of(const Vec3<F>& some, const Vec3<F>& all) {
  const auto share = [](const F& a, const F& b) { return select(b > 0, lane_min(F(a / b), F(1.0f)), F(0.0f)); };
  return {share(some.x, all.x), share(some.y, all.y), share(some.z, all.z)};
}

/// The rough part of a BSDF, or all of it in lanes of `whole`. Only `eval` is split; the density stays that of the
/// whole.
template <class Record, class F>
struct RoughPart {
  static constexpr bool is_lambertian = false;
  const Record& bsdf;
  RoughLimit limit;
  Mask<F> whole;

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Vec3<F> f = bsdf.eval(wo, wi);
    return select(whole, f, Vec3<F>(f * bsdf.rough_share(limit, wo, wi)));
  }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const { return bsdf.pdf(wo, wi); }
};

/// Decides whether a sample of the smooth part scattered by the rough part or by the rest; `u` is uniform in [0,1).
/// Multiplies the weight by the part's share of f over the probability of the decision.
template <class F>
Mask<F> is_by_rough_part(const Vec3<F>& rough_share, const F& u, Vec3<F>& weight) {
  const F q = (rough_share.x + rough_share.y + rough_share.z) * (1.0f / 3);
  const Mask<F> rough = u < q;
  const Vec3<F> share = select(rough, rough_share, Vec3<F>(Vec3<F>(F(1.0f)) - rough_share));
  weight *= share * F(1 / select(rough, q, F(1 - q)));
  return rough;
}

}  // namespace photonproof::inline renderer_bsdfs
