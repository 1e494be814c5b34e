// A point light with a cone: full intensity within the beam, then linear in the angle down to 0 at the cut-off.
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_sample.h"

namespace photonproof::inline renderer_lights {

/// 1 within `beam`, 0 beyond `cutoff`, linear in the angle between; half-angles in radians.
template <class F>
F spot_falloff(const F& angle, const F& beam, const F& cutoff) {
  const F ramp = (cutoff - angle) / select(cutoff > beam, cutoff - beam, F(1.0f));
  return select(angle <= beam, F(1.0f), select(angle < cutoff, ramp, F(0.0f)));
}

template <class F>
struct SpotLight {
  static constexpr bool is_delta = true, is_infinite = false;
  Vec3<F> position;
  Vec3<F> axis;       ///< unit
  Vec3<F> intensity;  ///< W sr^-1, along the axis
  F beam, cutoff;     ///< half-angles, radians; beam <= cutoff
  F one_minus_cos;    ///< value 1 - cos of the cut-off
  F mean_falloff;     ///< mean over the cone's solid angle

  LightSample<F> sample(const Vec3<F>& p, const Vec2<F>&) const {
    const Vec3<F> d = position - p;
    const F distance2 = dot(d, d);
    const F inverse = 1 / lane_sqrt(distance2);
    const Vec3<F> wi = d * inverse;
    const F falloff = falloff_towards(Vec3<F>(-wi));
    return {{position},
            wi,
            intensity * (falloff * inverse * inverse),
            select(distance2 > 0 && falloff > 0, F(1.0f), F(0.0f))};
  }
  F pdf(const Vec3<F>&, const LightPoint<F>&) const { return F(0.0f); }
  Emission<F> emit(const Vec2<F>&, const Vec2<F>& u) const {
    const Vec3<F> direction = Frame<F>(axis).to_world(square_to_cone(u, one_minus_cos));
    return {{position}, direction, intensity * (falloff_towards(direction) * solid_angle())};
  }
  EmissionPdfs<F> emit_pdfs(const LightPoint<F>&, const Vec3<F>& direction) const {
    return {F(1.0f), select(angle_between(axis, direction) < cutoff, 1 / solid_angle(), F(0.0f))};
  }
  Vec3<F> flux_towards(const LightPoint<F>&, const Vec3<F>& direction) const {
    return intensity * falloff_towards(direction);
  }
  Vec3<F> flux() const { return intensity * (mean_falloff * solid_angle()); }
  LightBounds bounds() const { return {position, position, axis, 0, cutoff, 0}; }
  Vec3<F> leaving(const LightPoint<F>&, const Vec3<F>& direction) const {
    return intensity * falloff_towards(direction);
  }

 private:
  F solid_angle() const { return 2 * pi * one_minus_cos; }
  F falloff_towards(const Vec3<F>& direction) const {
    return spot_falloff(F(angle_between(axis, direction)), beam, cutoff);
  }
};

inline double one_minus_cosine(double x) {
  const double half = std::sin(x / 2);
  return 2 * half * half;
}
/// The function 1 - sin(x) / x, with a relative error of 1e-11.
inline double one_minus_sinc(double x) {
  return std::abs(x) < 0.01 ? x * x / 6 * (1 - x * x / 20) : 1 - std::sin(x) / x;
}

/// The half-angles satisfy `beam_radians` <= `cutoff_radians`; the cut-off is above 0.
inline SpotLight<float> spot_light(const Vec3f& position, const Vec3f& axis, const Rgb& intensity, double beam_radians,
                                   double cutoff_radians) {
  // A form without the cancellation of 1 - cos(c). With m = (c + b) / 2 and h = (c - b) / 2, the mean of the falloff f
  // over the cone follows from these integrals.
  //   `integral f sin = (1 - cos b) + [integral from b to c of (c - t) sin(t) dt] / (c - b)`
  //   `               = 1 - (sin c - sin b) / (c - b) = 1 - cos m sinc h`.
  const double one_minus_cos = one_minus_cosine(cutoff_radians);
  const double middle = 0.5 * (cutoff_radians + beam_radians), half_width = 0.5 * (cutoff_radians - beam_radians);
  const double whole = one_minus_cosine(middle) + std::cos(middle) * one_minus_sinc(half_width);
  const double mean = std::clamp(whole / one_minus_cos, 0.0, 1.0);
  return {position,
          axis,
          intensity,
          static_cast<float>(beam_radians),
          static_cast<float>(cutoff_radians),
          static_cast<float>(one_minus_cos),
          static_cast<float>(mean)};
}

}  // namespace photonproof::inline renderer_lights
