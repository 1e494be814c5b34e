// Light from all around, at infinity: a sky says how much from where and how to draw directions; what lies between sky
// and scene is the same for all.
#pragma once

#include <variant>

#include "renderer/lights/light_sample.h"
#include "renderer/lights/sky_constant.h"
#include "renderer/lights/sky_envmap.h"
#include "renderer/lights/sky_sun.h"

namespace photonproof::inline renderer_lights {

/// A sky offers, of unit directions towards it in the world's frame:
///   radiance(d)   W m^-2 sr^-1
///   sample(u)     a direction
///   pdf(d)        its density per solid angle
///   irradiance()  the integral of radiance over all directions, W m^-2
using Sky = std::variant<ConstantSky, EnvmapSky, SunSky>;

class EnvironmentLight {
 public:
  static constexpr bool is_delta = false, is_infinite = true;

  /// `center`, `radius`: of the ball around the scene.
  EnvironmentLight(Sky sky, const Vec3f& center, float radius);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  /// Of the direction from p to the point.
  float pdf(const Vec3f& p, const LightPoint<float>& at) const;
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>&, const Vec3f& direction) const;
  /// Photons come through the disc, in no other direction than the one it faces.
  Rgb flux_towards(const LightPoint<float>&, const Vec3f&) const { return Rgb(0.0f); }
  Rgb leaving(const LightPoint<float>&, const Vec3f& direction) const { return radiance(-direction); }
  Rgb flux() const;

  Rgb radiance(const Vec3f& towards_sky) const;
  /// Density per solid angle of the directions that `sample` gives.
  float pdf_direction(const Vec3f& towards_sky) const;

 private:
  Sky sky_;
  Vec3f center_;
  float radius_;
};

}  // namespace photonproof::inline renderer_lights
