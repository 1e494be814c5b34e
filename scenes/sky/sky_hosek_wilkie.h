// The clear sky of Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", also used by
// Mitsuba's sunsky. It is a fit to path-traced skies over a reflecting ground, for turbidities from 1 to 10.
#pragma once

#include <array>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_sky {

/// The fit's data for one channel. For ground albedos 0 and 1 and turbidities 1 to 10 it has six Bezier points along
/// the cube root of the sun's height.
struct HosekWilkieTable {
  static constexpr int turbidities = 10, points = 6, parameters = 9;
  std::array<double, std::size_t{2} * turbidities * points * parameters> shape;  ///< equation 8's A to G, I, H
  std::array<double, std::size_t{2} * turbidities * points> mean;                ///< W m^-2 sr^-1
};

/// Tables for the red, green and blue of Rec. 709.
extern const std::array<HosekWilkieTable, 3> hosek_wilkie_tables;

class HosekWilkieSky {
 public:
  /// Turbidity from 1 to 10, ground albedo from 0 to 1, height of the sun above the horizon from 0 to pi/2 radians.
  HosekWilkieSky(double turbidity, double albedo, double sun_elevation);

  /// Radiance, W m^-2 sr^-1, by the cosines of the angles from the zenith, not negative, and from the sun.
  RgbD rgb(double cos_theta, double cos_gamma) const;

 private:
  struct Channel {
    std::array<double, HosekWilkieTable::parameters> shape;
    double mean;
  };
  std::array<Channel, 3> channels_;
};

}  // namespace photonproof::inline scenes_sky
