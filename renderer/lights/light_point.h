// Isotropic point light: irradiance I cos / d^2.
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_sample.h"

namespace photonproof::inline renderer_lights {

template <class F>
struct PointLight {
  static constexpr bool is_delta = true, is_infinite = false;
  Vec3<F> position;
  Vec3<F> intensity;  ///< W sr^-1

  LightSample<F> sample(const Vec3<F>& p, const Vec2<F>&) const {
    const Vec3<F> d = position - p;
    const F distance2 = dot(d, d);
    const F inverse = 1 / lane_sqrt(distance2);
    return {{position}, d * inverse, intensity * (inverse * inverse), select(distance2 > 0, F(1.0f), F(0.0f))};
  }
  F pdf(const Vec3<F>&, const LightPoint<F>&) const { return F(0.0f); }
  Emission<F> emit(const Vec2<F>&, const Vec2<F>& u) const { return {{position}, square_to_sphere(u), flux()}; }
  EmissionPdfs<F> emit_pdfs(const LightPoint<F>&, const Vec3<F>&) const { return {F(1.0f), F(1 / (4 * pi))}; }
  Vec3<F> flux_towards(const LightPoint<F>&, const Vec3<F>&) const { return intensity; }
  Vec3<F> leaving(const LightPoint<F>&, const Vec3<F>&) const { return intensity; }
  Vec3<F> flux() const { return intensity * (4 * pi); }
  LightBounds bounds() const { return round_bounds(position, position); }
};

}  // namespace photonproof::inline renderer_lights
