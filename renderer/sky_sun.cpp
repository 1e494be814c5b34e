#include "renderer/sky_sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/warp.h"

namespace photonproof {
namespace {

constexpr double pi_d = std::numbers::pi;
constexpr double y_integral = 106.856895;              // of the CIE 1931 y function, nm
constexpr double luminous_efficacy = 683.002;          // lm/W at 555 nm
constexpr double real_aperture = 0.5358 * pi_d / 180;  // full angle of the sun

double cone(double full_angle) {
  const double s = std::sin(full_angle / 4);
  return 4 * pi_d * s * s;  // 2 pi (1 - cos(angle / 2))
}

RgbD xyz_to_rgb(const Vec3d& xyz) {
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

RgbD not_negative(const RgbD& rgb) { return {std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0)}; }

/// CIE 1931 colour matching functions, the multi-lobe fit of Wyman, Sloan and Shirley 2013.
Vec3d colour_matching(double nm) {
  const auto lobe = [&](double mean, double below, double above) {
    const double t = (nm - mean) / (nm < mean ? below : above);
    return std::exp(-0.5 * t * t);
  };
  return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
          0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
          1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

/// Preetham et al. 1999, table 2, every 10 nm from 380 to 750: radiance of the sun above the air, 100 W m^-2 sr^-1
/// nm^-1; absorption of ozone, cm^-1; of water vapour, cm^-1; of mixed gases, none below 760 nm.
constexpr double first_nm = 380, step_nm = 10;
constexpr std::array<double, 38> sun_above_air{
    165.590, 162.337, 211.275, 258.882, 258.291, 242.323, 267.605, 296.583, 305.454, 300.575, 306.637, 288.304, 287.121,
    278.250, 271.006, 272.336, 263.613, 255.038, 250.602, 253.116, 253.559, 251.342, 246.315, 241.732, 236.853, 232.121,
    228.277, 223.398, 219.702, 215.267, 210.979, 207.283, 202.404, 198.708, 194.272, 190.724, 186.289, 182.592};
constexpr std::array<double, 38> ozone{0,     0,     0,     0,     0,     0,     0.003, 0.003, 0.006, 0.009,
                                       0.014, 0.021, 0.03,  0.04,  0.048, 0.063, 0.075, 0.085, 0.103, 0.12,
                                       0.12,  0.115, 0.125, 0.12,  0.105, 0.09,  0.079, 0.067, 0.057, 0.048,
                                       0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.01,  0.009};
double water_vapour(std::size_t sample) {
  constexpr std::array<double, 7> from_690nm{0.016, 0.024, 0.0125, 1, 0.87, 0.061, 0.001};
  constexpr std::size_t first = 31;  // 690 nm
  return sample < first ? 0 : from_690nm[sample - first];
}

}  // namespace

RgbD sun_disc_radiance(double cos_theta_sun, double turbidity) {
  if (cos_theta_sun < 0) return RgbD(0.0);
  const double beta = 0.04608 * turbidity - 0.04586;  // Angstrom's coefficient
  const double degrees = std::acos(std::min(cos_theta_sun, 1.0)) * 180 / pi_d;
  const double air_mass = 1 / (cos_theta_sun + 0.15 * std::pow(93.885 - degrees, -1.253));
  Vec3d xyz(0.0);
  for (std::size_t i = 0; i < sun_above_air.size(); ++i) {
    const double nm = first_nm + step_nm * static_cast<double>(i);
    const double micrometres = nm / 1000;
    const double rayleigh = 0.008735 * std::pow(micrometres, -4.08) * air_mass;
    const double aerosol = beta * std::pow(micrometres, -1.3) * air_mass;
    const double by_ozone = ozone[i] * 0.35 * air_mass;
    const double vapour = water_vapour(i) * 2 * air_mass;
    const double by_vapour = 0.2385 * vapour / std::pow(1 + 20.07 * vapour, 0.45);
    const double radiance = 100 * sun_above_air[i] * std::exp(-rayleigh - aerosol - by_ozone - by_vapour);
    xyz += colour_matching(nm) * (radiance * step_nm / y_integral);
  }
  return not_negative(xyz_to_rgb(xyz));
}

double SunSky::Perez::at(double cos_theta, double gamma) const {
  const double cos_gamma = std::cos(gamma);
  return scale * (1 + a * std::exp(b / std::max(cos_theta, 1e-4))) *
         (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
}

SunSky::SunSky(const SunSkySettings& settings)
    : sky_scale_(settings.sky_scale),
      x_(normalize(settings.to_world.vector({1, 0, 0}))),
      y_(normalize(settings.to_world.vector({0, 1, 0}))),
      z_(normalize(settings.to_world.vector({0, 0, 1}))),
      sun_(normalize(settings.sun_direction)) {
  const double t = std::clamp(settings.turbidity, 2.0, 10.0);
  // A sun that has set leaves the sky it had on the horizon.
  const double theta_sun = std::acos(std::clamp(double{sun_.z}, 0.0, 1.0));
  const double s = theta_sun, s2 = s * s, s3 = s2 * s;
  const double chi = (4.0 / 9 - t / 120) * (pi_d - 2 * s);
  const std::array<double, 3> zenith{
      (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192,
      t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) + t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
          0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886,
      t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) + t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
          0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688};
  perez_ = {Perez{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                  -0.0670 * t + 0.3703, 1},
            Perez{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                  -0.0033 * t + 0.0452, 1},
            Perez{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                  -0.0109 * t + 0.0529, 1}};
  for (std::size_t i = 0; i < 3; ++i) perez_[i].scale = std::max(zenith[i], 0.0) / perez_[i].at(1, theta_sun);

  const double aperture = settings.sun_aperture_radians;
  const double half = std::sin(aperture / 4);
  sun_one_minus_cos_ = static_cast<float>(2 * half * half);
  // Where the disc is on the horizon only its upper part shines, as bright as its middle.
  sun_radiance_ =
      Rgb(sun_disc_radiance(double{sun_.z}, t) * (settings.sun_scale * cone(real_aperture) / cone(aperture)));

  std::vector<double> weights;
  RgbD total(0.0);
  constexpr double cell = 2 * pi_d / (rows * columns);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double z = (row + 0.5) / rows, r = std::sqrt(1 - z * z), phi = (column + 0.5) * 2 * pi_d / columns;
      const RgbD value = sky({r * std::cos(phi), r * std::sin(phi), z});
      total += value * cell;
      weights.push_back((value.x + value.y + value.z) / 3 * cell);
    }
  // Cells hold more than their middle shows; none is left out.
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w += 0.05 * sum / static_cast<double>(weights.size());
  cells_ = DiscreteDistribution(weights);
  const RgbD from_sun = RgbD(sun_radiance_) * cone(aperture);
  const double sun_power = (from_sun.x + from_sun.y + from_sun.z) / 3;
  sun_probability_ = sun_power <= 0 ? 0.0f
                     : sum <= 0     ? 1.0f
                                    : static_cast<float>(std::clamp(sun_power / (sun_power + sum), 0.1, 0.9));
  irradiance_ = Rgb(total + from_sun);
}

RgbD SunSky::sky(const Vec3d& local) const {
  if (local.z < 0 || sky_scale_ == 0) return RgbD(0.0);
  const double gamma = std::acos(std::clamp(dot(local, Vec3d(sun_)), -1.0, 1.0));
  const double luminance = perez_[0].at(local.z, gamma);
  const double x = perez_[1].at(local.z, gamma), y = perez_[2].at(local.z, gamma);
  const double radiant = luminance * 1000 / (luminous_efficacy * y_integral) * sky_scale_;
  if (!(y > 0) || !(radiant > 0)) return RgbD(0.0);
  return not_negative(xyz_to_rgb({x / y * radiant, radiant, (1 - x - y) / y * radiant}));
}

bool SunSky::in_sun(const Vec3f& local) const {
  const Vec3f apart = local - sun_;
  return local.z >= 0 && dot(apart, apart) * 0.5f <= sun_one_minus_cos_;  // |a - b|^2 = 2 (1 - cos)
}

Rgb SunSky::radiance(const Vec3f& towards_sky) const {
  const Vec3f local = to_local(towards_sky);
  const Rgb above = Rgb(sky(Vec3d(local)));
  return in_sun(local) ? above + sun_radiance_ : above;
}

Vec3f SunSky::sample(const Vec2<float>& u) const {
  if (u.x < sun_probability_)
    return normalize(to_world(
        Frame<float>(sun_).to_world(square_to_cone(Vec2<float>{u.x / sun_probability_, u.y}, sun_one_minus_cos_))));
  const float rest = (u.x - sun_probability_) / (1 - sun_probability_);
  const DiscreteDistribution::Drawn drawn = cells_.sample(std::min(rest, 1 - 0x1p-24f));
  const double z = (static_cast<double>(drawn.index / columns) + double{drawn.u}) / rows;
  const double phi = (static_cast<double>(drawn.index % columns) + double{u.y}) * 2 * pi_d / columns;
  const double r = std::sqrt(1 - z * z);
  return normalize(to_world(Vec3f(Vec3d(r * std::cos(phi), r * std::sin(phi), z))));
}

float SunSky::pdf(const Vec3f& towards_sky) const {
  const Vec3f local = to_local(towards_sky);
  const Vec3f apart = local - sun_;
  float density = 0;
  if (sun_probability_ > 0 && dot(apart, apart) * 0.5f <= sun_one_minus_cos_)
    density += sun_probability_ / (2 * pi * sun_one_minus_cos_);
  if (local.z >= 0 && sun_probability_ < 1) {
    const int row = std::clamp(static_cast<int>(local.z * rows), 0, rows - 1);
    float turn = std::atan2(local.y, local.x) / (2 * pi);
    if (turn < 0) turn += 1;
    const int column = std::clamp(static_cast<int>(turn * columns), 0, columns - 1);
    const auto cell = static_cast<std::size_t>(row * columns + column);
    density += (1 - sun_probability_) * cells_.probability(cell) * (rows * columns / (2 * pi));
  }
  return density;
}

}  // namespace photonproof
