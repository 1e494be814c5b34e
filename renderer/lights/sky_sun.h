// Sun and clear sky (scenes/sky/clear_sky.h), looked up and sampled. Local +z is up; there is nothing below the
// horizon.
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
  Transform to_world;                     ///< its rotation counts
};

/// The sun's aperture as it is rendered, degrees: directions in single precision tell no smaller one from a point.
inline float usable_sun_aperture(float degrees) { return std::max(degrees, 5e-4f); }

class SunSky {
 public:
  explicit SunSky(const SunSkySettings& settings);

  Rgb radiance(const Vec3f& towards_sky) const;
  Vec3f sample(const Vec2<float>& u) const;
  float pdf(const Vec3f& towards_sky) const;
  Rgb irradiance() const { return irradiance_; }

 private:
  static constexpr int rows = 64, columns = 128;  ///< of the hemisphere: equal steps of height and azimuth

  bool in_sun(const Vec3f& local) const;
  Vec3f to_local(const Vec3f& d) const { return {dot(d, x_), dot(d, y_), dot(d, z_)}; }
  Vec3f to_world(const Vec3f& d) const { return x_ * d.x + y_ * d.y + z_ * d.z; }

  ClearSky sky_;
  Vec3f x_, y_, z_;  ///< local axes in the world, unit
  Vec3f sun_;        ///< local
  float sun_one_minus_cos_;
  float drawn_one_minus_cos_;  ///< of the cone in which directions to it are drawn, to be in it when rounded
  Rgb sun_radiance_;
  float sun_probability_;
  DiscreteDistribution cells_;
  Rgb irradiance_;
};

}  // namespace photonproof::inline renderer_lights
