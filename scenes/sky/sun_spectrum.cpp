#include "scenes/sky/sun_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/description/spectrum.h"

namespace photonproof {
namespace {

/// Table 2: radiance of the sun above the air, 100 W m^-2 sr^-1 nm^-1; absorption of ozone, cm^-1; of water vapour,
/// cm^-1; of mixed gases, none below 760 nm.
constexpr std::array<double, sun_samples> above_air{
    165.590, 162.337, 211.275, 258.882, 258.291, 242.323, 267.605, 296.583, 305.454, 300.575, 306.637, 288.304, 287.121,
    278.250, 271.006, 272.336, 263.613, 255.038, 250.602, 253.116, 253.559, 251.342, 246.315, 241.732, 236.853, 232.121,
    228.277, 223.398, 219.702, 215.267, 210.979, 207.283, 202.404, 198.708, 194.272, 190.724, 186.289, 182.592};
constexpr std::array<double, sun_samples> ozone{0,     0,     0,     0,     0,     0,     0.003, 0.003, 0.006, 0.009,
                                                0.014, 0.021, 0.03,  0.04,  0.048, 0.063, 0.075, 0.085, 0.103, 0.12,
                                                0.12,  0.115, 0.125, 0.12,  0.105, 0.09,  0.079, 0.067, 0.057, 0.048,
                                                0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.01,  0.009};
double water_vapour(std::size_t sample) {
  constexpr std::array<double, 7> from_690nm{0.016, 0.024, 0.0125, 1, 0.87, 0.061, 0.001};
  constexpr std::size_t first = 31;  // 690 nm
  return sample < first ? 0 : from_690nm[sample - first];
}

double nm_of(std::size_t sample) { return sun_first_nm + sun_step_nm * static_cast<double>(sample); }

}  // namespace

double relative_air_mass(double cos_theta_sun) {
  const double degrees = std::acos(std::min(cos_theta_sun, 1.0)) * 180 / std::numbers::pi;
  return 1 / (cos_theta_sun + 0.15 * std::pow(93.885 - degrees, -1.253));
}

AirTransmittance air_transmittance(std::size_t sample, double air_mass, double turbidity) {
  constexpr double ozone_cm = 0.35, water_cm = 2;     // above us
  const double beta = 0.04608 * turbidity - 0.04586;  // Angstrom's coefficient
  const double micrometres = nm_of(sample) / 1000;
  const double vapour = water_vapour(sample) * water_cm * air_mass;
  return {std::exp(-0.008735 * std::pow(micrometres, -4.08) * air_mass),
          std::exp(-beta * std::pow(micrometres, -1.3) * air_mass), std::exp(-ozone[sample] * ozone_cm * air_mass),
          std::exp(-0.2385 * vapour / std::pow(1 + 20.07 * vapour, 0.45))};
}

std::array<double, sun_samples> sun_spectral_radiance(double cos_theta_sun, double turbidity) {
  const double air_mass = relative_air_mass(cos_theta_sun);
  std::array<double, sun_samples> radiance{};
  for (std::size_t i = 0; i < sun_samples; ++i)
    radiance[i] = 100 * above_air[i] * air_transmittance(i, air_mass, turbidity).all();
  return radiance;
}

RgbD sun_disc_radiance(double cos_theta_sun, double turbidity) {
  if (cos_theta_sun < 0) return RgbD(0.0);
  const std::array<double, sun_samples> radiance = sun_spectral_radiance(cos_theta_sun, turbidity);
  std::vector<SpectrumSample> samples;
  for (std::size_t i = 0; i < sun_samples; ++i) samples.push_back({nm_of(i), radiance[i]});
  return rgb_of_spectrum(samples, SpectrumKind::emission);
}

}  // namespace photonproof
