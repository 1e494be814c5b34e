// Sun and clear sky (scenes/sky/clear_sky.h): radiance and sampling. Local +z is up; below the horizon the radiance is
// 0.
#pragma once

#include <algorithm>

#include "renderer/core/discrete_distribution.h"
#include "scenes/base/vec.h"
#include "scenes/description/transform.h"
#include "scenes/sky/clear_sky.h"

namespace photonproof::inline renderer_lights {

struct SunSkySettings {
  Vec3d sun_direction{0, 0, 1};  ///< local, unit, towards the sun
  double turbidity = 3;          ///< 1 to 10
  RgbD albedo{0.3};              ///< of the ground, 0 to 1
  double sun_scale = 1, sky_scale = 1;
  double sun_aperture_radians = 0.00935;  ///< full angle, usable; the sun's irradiance does not depend on it
  Transform to_world;                     ///< only its rotation is used
};

/// The rendered sun aperture in degrees: single-precision directions cannot resolve a smaller one.
inline float usable_sun_aperture(float degrees) { return std::max(degrees, 5e-4f); }

class SunSky {
 public:
  explicit SunSky(const SunSkySettings& settings);

  Rgb radiance(const Vec3f& towards_sky) const;
  Vec3f sample(const Vec2<float>& u) const;
  float pdf(const Vec3f& towards_sky) const;
  Rgb irradiance() const { return irradiance_; }

 private:
  static constexpr int rows = 64, columns = 128;  ///< grid of the hemisphere: equal steps of height and azimuth

  bool in_sun(const Vec3f& local) const;
  Vec3f to_local(const Vec3f& d) const { return {dot(d, x_), dot(d, y_), dot(d, z_)}; }
  Vec3f to_world(const Vec3f& d) const { return x_ * d.x + y_ * d.y + z_ * d.z; }

  ClearSky sky_;
  Vec3f x_, y_, z_;  ///< local axes in the world, unit
  Vec3f sun_;        ///< local
  float sun_one_minus_cos_;
  float drawn_one_minus_cos_;  ///< narrower sampling cone, so that rounded directions lie in the sun
  Rgb sun_radiance_;
  float sun_probability_;
  DiscreteDistribution cells_;
  Rgb irradiance_;
};

}  // namespace photonproof::inline renderer_lights
