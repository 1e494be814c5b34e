// A diffuse base under a smooth clear coat, as numbers for engines without such a material. It covers Mitsuba's
// `plastic`, and a lacquer over a diffuse base (Weidlich and Wilkie 2007).
//   BSDF: f = T(o) a(o) T(i) a(i) base / pi, and a mirror of reflectance 1 - T.
// T is the Fresnel transmittance of the coat's surface at a direction's cosine, a the coat's transmittance along it.
// The base is rho / (eta^2 (1 - rho R)); R is the share of the base's light that the surface reflects back inside.
#pragma once

#include <array>
#include <complex>

#include "scenes/description/description.h"

namespace photonproof::inline reference_optics {

/// Unpolarised reflectance at the boundary to a medium of this index, relative to the medium before it. `cosine` is of
/// the angle of incidence, 0 to 1.
double fresnel_reflectance(double cosine, const std::complex<double>& index);

struct Coat {
  double index = 1.5;  ///< the coat's index over that of the medium above it, at least 1
  RgbD depth{0.0};     ///< absorption times thickness
  RgbD base{0.0};      ///< as above
  RgbD specular{1.0};  ///< scales the mirror

  /// T a at an outside cosine, 0 to 1.
  RgbD crossing(double cosine) const;
  RgbD mirror(double cosine) const { return specular * fresnel_reflectance(cosine, index); }
  /// T a averaged over diffuse light: the integral of 2 cos T a over cos.
  RgbD mean_crossing() const;
  /// Albedo of the base through the coat under diffuse light.
  RgbD diffuse_albedo() const { return mean_crossing() * mean_crossing() * base; }
};

Coat coat_of(const PlasticDescription& plastic, const RgbD& diffuse, const RgbD& specular);
Coat coat_of(const LayeredDescription& lacquer, const RgbD& diffuse, const RgbD& specular);

/// Coefficients c of cos, cos^2, ... whose sum is closest to crossing(cos), in the mean over a diffuse light's cosines,
/// among those with the same mean. For indices from 1.3 to 1.9 without absorption the error is within 0.3 % wherever
/// cos > 0.15.
constexpr std::size_t coat_powers = 6;
std::array<RgbD, coat_powers> crossing_by_powers(const Coat& coat);

}  // namespace photonproof::inline reference_optics
