#include "scenes/sky/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/description/spectrum.h"
#include "scenes/sky/sun_irradiance.h"

namespace photonproof::inline scenes_sky {
namespace {

RgbD not_negative(const RgbD& rgb) { return {std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0)}; }

}  // namespace

ClearSky::ClearSky(double turbidity, const RgbD& ground_albedo, const Vec3d& sun_direction, double scale)
    : sun_(sun_direction), scale_(sun_direction.z < 0 ? 0 : scale) {
  const double height = std::asin(std::clamp(sun_direction.z, 0.0, 1.0));
  skies_.emplace_back(turbidity, ground_albedo.x, height);
  if (ground_albedo != RgbD(ground_albedo.x))
    for (const double other : {ground_albedo.y, ground_albedo.z}) skies_.emplace_back(turbidity, other, height);
}

RgbD ClearSky::radiance(const Vec3d& local) const {
  if (local.z < 0 || scale_ == 0) return RgbD(0.0);
  const double cos_gamma = std::clamp(dot(local, sun_), -1.0, 1.0);
  const auto over = [&](const HosekWilkieSky& sky) {
    return not_negative(sky.rgb(local.z, cos_gamma) * (scale_ / cie_y_integral));
  };
  if (skies_.size() == 1) return over(skies_[0]);
  return {over(skies_[0]).x, over(skies_[1]).y, over(skies_[2]).z};
}

double cone_solid_angle(double full_angle) {
  const double s = std::sin(full_angle / 4);
  return 4 * std::numbers::pi * s * s;  // 2 pi (1 - cos(angle / 2))
}

RgbD sun_radiance(double cos_theta_sun, double turbidity, double aperture) {
  if (cos_theta_sun < 0) return RgbD(0.0);
  const double height = std::asin(std::min(cos_theta_sun, 1.0)) * 180 / std::numbers::pi;
  return sun_irradiance(height, turbidity) / cone_solid_angle(aperture);
}

}  // namespace photonproof::inline scenes_sky
