// The light of a `sunsky`: the sky (sky_hosek_wilkie.h) and the sun (sun_irradiance.h) of Hosek and Wilkie. Units are
// those of Mitsuba's sunsky: radiance per nanometre, W m^-2 sr^-1 nm^-1, as linear Rec. 709. The integral of the CIE
// 1931 y function is divided out (cie_y_integral). Local +z is up. All is dark when the sun is below the horizon.
#pragma once

#include <vector>

#include "scenes/base/vec.h"
#include "scenes/sky/sky_hosek_wilkie.h"

namespace photonproof::inline scenes_sky {

class ClearSky {
 public:
  /// `sun_direction` is of unit length, towards the sun. The ground's albedo is per channel. `scale` multiplies the
  /// radiance.
  ClearSky(double turbidity, const RgbD& ground_albedo, const Vec3d& sun_direction, double scale);

  /// Sky radiance in a unit direction without the sun's disc; black below the horizon.
  RgbD radiance(const Vec3d& local) const;

 private:
  /// One sky per component of the ground's albedo; one for all where it is grey.
  std::vector<HosekWilkieSky> skies_;
  Vec3d sun_;
  double scale_;
};

/// Steradians of a cone of this full angle, radians.
double cone_solid_angle(double full_angle);

/// Radiance of a disc of this full angle, in radians, that has the sun's irradiance.
RgbD sun_radiance(double cos_theta_sun, double turbidity, double aperture);

}  // namespace photonproof::inline scenes_sky
