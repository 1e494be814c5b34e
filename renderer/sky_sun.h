// Sun and clear sky: Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight". Local +z is up; there
// is nothing below the horizon. Units are those of Mitsuba's sunsky: radiance per nanometre, W m^-2 sr^-1 nm^-1, as
// linear Rec.709 of XYZ with the integral of the CIE 1931 y function (106.86 nm) divided out.
//
// Mitsuba's sunsky is another model (Hosek and Wilkie 2012 and 2013): shapes and magnitudes agree in daylight, numbers
// do not. This one knows no ground albedo, no darkening of the sun's limb and no turbidity below 2, which is then taken
// as 2.
#pragma once

#include <array>

#include "renderer/discrete_distribution.h"
#include "scenes/transform.h"
#include "scenes/vec.h"

namespace photonproof {

struct SunSkySettings {
  Vec3d sun_direction{0, 0, 1};  ///< local, unit, towards the sun
  double turbidity = 3;
  double sun_scale = 1, sky_scale = 1;
  double sun_aperture_radians = 0.00935;  ///< full angle; the sun's irradiance does not depend on it
  Transform to_world;                     ///< its rotation counts
};

class SunSky {
 public:
  explicit SunSky(const SunSkySettings& settings);

  Rgb radiance(const Vec3f& towards_sky) const;
  Vec3f sample(const Vec2<float>& u) const;
  float pdf(const Vec3f& towards_sky) const;
  Rgb irradiance() const { return irradiance_; }

 private:
  static constexpr int rows = 64, columns = 128;  ///< of the hemisphere: equal steps of height and azimuth

  RgbD sky(const Vec3d& local) const;
  bool in_sun(const Vec3f& local) const;
  Vec3f to_local(const Vec3f& d) const { return {dot(d, x_), dot(d, y_), dot(d, z_)}; }
  Vec3f to_world(const Vec3f& d) const { return x_ * d.x + y_ * d.y + z_ * d.z; }

  /// Relative luminance or chromaticity after Perez: zenith value and five coefficients.
  struct Perez {
    double a, b, c, d, e;
    double scale;  ///< the zenith's value over the function there
    double at(double cos_theta, double gamma) const;
  };
  std::array<Perez, 3> perez_;  ///< of Y (kcd/m^2), x, y
  double sky_scale_;
  Vec3f x_, y_, z_;  ///< local axes in the world, unit
  Vec3f sun_;        ///< local
  float sun_one_minus_cos_;
  Rgb sun_radiance_;
  float sun_probability_;
  DiscreteDistribution cells_;
  Rgb irradiance_;
};

/// Radiance of the sun's disc seen from the ground at this height, of the real sun's size, in SunSky's units.
RgbD sun_disc_radiance(double cos_theta_sun, double turbidity);

}  // namespace photonproof
