// Light from all directions, at infinity. A sky gives radiance and samples directions; the transport between sky and
// scene is the same for all skies.
#pragma once

#include <variant>

#include "renderer/lights/light_sample.h"
#include "renderer/lights/sky_constant.h"
#include "renderer/lights/sky_envmap.h"
#include "renderer/lights/sky_sun.h"

namespace photonproof::inline renderer_lights {

/// A sky has these functions of unit directions towards it, in world coordinates.
///   `radiance(d)`: W m^-2 sr^-1.
///   `sample(u)`: a direction.
///   `pdf(d)`: its density per solid angle.
///   `irradiance()`: the integral of radiance over all directions, W m^-2.
using Sky = std::variant<ConstantSky, EnvmapSky, SunSky>;

class EnvironmentLight {
 public:
  static constexpr bool is_delta = false, is_infinite = true;

  /// The ball around the scene has this `center` and `radius`.
  EnvironmentLight(Sky sky, const Vec3f& center, float radius);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  /// Density of the direction from p to the point.
  float pdf(const Vec3f& p, const LightPoint<float>& at) const;
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>&, const Vec3f& direction) const;
  /// Photons pass the disc only in the direction that it faces.
  Rgb flux_towards(const LightPoint<float>&, const Vec3f&) const { return Rgb(0.0f); }
  Rgb leaving(const LightPoint<float>&, const Vec3f& direction) const { return radiance(-direction); }
  Rgb flux() const;

  Rgb radiance(const Vec3f& towards_sky) const;
  /// Density per solid angle of directions from `sample`.
  float pdf_direction(const Vec3f& towards_sky) const;

 private:
  Sky sky_;
  Vec3f center_;
  float radius_;
};

}  // namespace photonproof::inline renderer_lights
