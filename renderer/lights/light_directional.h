// Light from one direction, at infinity: irradiance E cos. Photons start on the disc across the ball around the scene.
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/lights/light_sample.h"

namespace photonproof::inline renderer_lights {

template <class F>
struct DirectionalLight {
  static constexpr bool is_delta = true, is_infinite = true;
  Vec3<F> direction;   ///< unit direction of travel
  Vec3<F> irradiance;  ///< W m^-2 on a surface facing the light
  Vec3<F> center;      ///< centre of the ball around the scene
  F radius;

  LightSample<F> sample(const Vec3<F>& p, const Vec2<F>&) const {
    const Vec3<F> wi = -direction;
    return {{advance(p, reach_beyond(center, radius, p), wi)}, wi, irradiance, F(1.0f)};
  }
  F pdf(const Vec3<F>&, const LightPoint<F>&) const { return F(0.0f); }
  Emission<F> emit(const Vec2<F>& u_position, const Vec2<F>&) const {
    const Vec2<F> d = square_to_disc(u_position);
    const Vec3<F> across = Frame<F>(direction).to_world(Vec3<F>(d.x, d.y, F(-1.0f)));
    return {{advance(center, radius, across)}, direction, flux()};
  }
  EmissionPdfs<F> emit_pdfs(const LightPoint<F>&, const Vec3<F>&) const { return {F(1.0f), 1 / disc_area()}; }
  /// No flux leaves in any other direction.
  Vec3<F> flux_towards(const LightPoint<F>&, const Vec3<F>&) const { return Vec3<F>(F(0.0f)); }
  Vec3<F> flux() const { return irradiance * disc_area(); }
  Vec3<F> leaving(const LightPoint<F>&, const Vec3<F>&) const { return irradiance; }

 private:
  F disc_area() const { return pi * radius * radius; }
};

}  // namespace photonproof::inline renderer_lights
