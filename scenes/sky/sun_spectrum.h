// The sun seen from the ground through clear air: appendix A.1 of Preetham, Shirley and Smits 1999, "A Practical
// Analytic Model for Daylight", after Iqbal 1983. From 380 to 750 nm every 10 nm, the range of its table 2.
#pragma once

#include <array>

#include "scenes/meshes/vec.h"

namespace photonproof {

inline constexpr std::size_t sun_samples = 38;
inline constexpr double sun_first_nm = 380, sun_step_nm = 10;

/// How many times the air above us a ray from the sun passes (Kasten 1966): 1 in the zenith, 36 on the horizon.
double relative_air_mass(double cos_theta_sun);

/// Transmittances of the air at one of the samples.
struct AirTransmittance {
  double rayleigh, aerosol, ozone, water_vapour;
  double all() const { return rayleigh * aerosol * ozone * water_vapour; }
};
AirTransmittance air_transmittance(std::size_t sample, double air_mass, double turbidity);

/// W m^-2 sr^-1 nm^-1, mean over the disc, for a sun that is up.
std::array<double, sun_samples> sun_spectral_radiance(double cos_theta_sun, double turbidity);

/// The same as linear Rec. 709, in the units of clear_sky.h; black for a sun below the horizon.
RgbD sun_disc_radiance(double cos_theta_sun, double turbidity);

}  // namespace photonproof
