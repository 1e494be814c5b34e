#include "scenes/curves/hair_colour.h"

#include <cmath>

namespace photonproof::inline scenes_curves {

RgbD absorption_of_pigments(double eumelanin, double pheomelanin) {
  return RgbD{0.419, 0.697, 1.37} * eumelanin + RgbD{0.187, 0.4, 1.05} * pheomelanin;
}

RgbD colour_of_hair(const RgbD& absorption, double roughness) {
  const double b = roughness;
  const double fit = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
  const auto reflectance = [fit](double a) { return std::exp(-std::sqrt(a) * fit); };
  return {reflectance(absorption.x), reflectance(absorption.y), reflectance(absorption.z)};
}

}  // namespace photonproof::inline scenes_curves
