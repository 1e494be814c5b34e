// A diffuse base under a smooth clear coat, in numbers that an engine without such a material can be given: Mitsuba's
// `plastic`, and a lacquer over a diffuse base (Weidlich and Wilkie 2007). With T the Fresnel transmittance of the
// coat's surface at a direction's cosine and a what the coat absorbs along it,
//   f = T(o) a(o) T(i) a(i) base / pi, and a mirror of reflectance 1 - T
// base = rho / (eta^2 (1 - rho R)), R the share of the base's light that comes back from the surface inside.
#pragma once

#include <array>
#include <complex>

#include "scenes/description/description.h"

namespace photonproof::inline reference_optics {

/// Unpolarised reflectance at the boundary to a medium of this index, relative to the one before it; `cosine` of the
/// angle of incidence, 0 to 1.
double fresnel_reflectance(double cosine, const std::complex<double>& index);

struct Coat {
  double index = 1.5;  ///< of the coat over that of what is above it, at least 1
  RgbD depth{0.0};     ///< absorption times thickness
  RgbD base{0.0};      ///< as above
  RgbD specular{1.0};  ///< scales the mirror

  /// T a at a cosine outside, 0 to 1.
  RgbD crossing(double cosine) const;
  RgbD mirror(double cosine) const { return specular * fresnel_reflectance(cosine, index); }
  /// Of diffuse light: the integral of 2 cos T a over cos.
  RgbD mean_crossing() const;
  /// Of the base through the coat, for diffuse light.
  RgbD diffuse_albedo() const { return mean_crossing() * mean_crossing() * base; }
};

Coat coat_of(const PlasticDescription& plastic, const RgbD& diffuse, const RgbD& specular);
Coat coat_of(const LayeredDescription& lacquer, const RgbD& diffuse, const RgbD& specular);

/// Coefficients c of cos, cos^2 ... that make the sum nearest to crossing(cos), in the mean over a diffuse light's
/// cosines, among those with the same mean. For indices from 1.3 to 1.9 without absorption within 0.3 % wherever cos >
/// 0.15.
constexpr std::size_t coat_powers = 6;
std::array<RgbD, coat_powers> crossing_by_powers(const Coat& coat);

}  // namespace photonproof::inline reference_optics
