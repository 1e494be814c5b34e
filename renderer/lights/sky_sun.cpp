#include "renderer/lights/sky_sun.h"

#include <algorithm>
#include <cmath>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {
namespace {

/// Rounding error of a direction that is sampled about another and rotated twice, in radians at most.
constexpr double rounding_of_directions = 0x1p-22;

}  // namespace

SunSky::SunSky(const SunSkySettings& settings)
    : sky_(settings.turbidity, settings.albedo, normalize(settings.sun_direction), settings.sky_scale),
      x_(normalize(settings.to_world.vector({1, 0, 0}))),
      y_(normalize(settings.to_world.vector({0, 1, 0}))),
      z_(normalize(settings.to_world.vector({0, 0, 1}))),
      sun_(normalize(settings.sun_direction)) {
  const double aperture = settings.sun_aperture_radians;
  sun_one_minus_cos_ = static_cast<float>(cone_solid_angle(aperture) / (2 * pi_d));
  drawn_one_minus_cos_ = static_cast<float>(cone_solid_angle(aperture - 2 * rounding_of_directions) / (2 * pi_d));
  // Only the upper part of a disc on the horizon shines, as bright as its middle.
  sun_radiance_ = Rgb(photonproof::sun_radiance(double{sun_.z}, settings.turbidity, aperture) * settings.sun_scale);

  std::vector<double> weights;
  RgbD total(0.0);
  constexpr double cell = 2 * pi_d / (rows * columns);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double z = (row + 0.5) / rows, r = std::sqrt(1 - z * z), phi = (column + 0.5) * 2 * pi_d / columns;
      const RgbD value = sky_.radiance({r * std::cos(phi), r * std::sin(phi), z});
      total += value * cell;
      weights.push_back((value.x + value.y + value.z) / 3 * cell);
    }
  // Cells may hold more radiance than their middle shows, so every cell gets a minimum weight.
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w += 0.05 * sum / static_cast<double>(weights.size());
  cells_ = DiscreteDistribution(weights);
  const RgbD from_sun = RgbD(sun_radiance_) * cone_solid_angle(aperture);
  const double sun_power = (from_sun.x + from_sun.y + from_sun.z) / 3;
  sun_probability_ = sun_power <= 0 ? 0.0f
                     : sum <= 0     ? 1.0f
                                    : static_cast<float>(std::clamp(sun_power / (sun_power + sum), 0.1, 0.9));
  irradiance_ = Rgb(total + from_sun);
}

bool SunSky::in_sun(const Vec3f& local) const {
  const Vec3f apart = local - sun_;
  return local.z >= 0 && dot(apart, apart) * 0.5f <= sun_one_minus_cos_;  // |a - b|^2 = 2 (1 - cos)
}

Rgb SunSky::radiance(const Vec3f& towards_sky) const {
  const Vec3f local = to_local(towards_sky);
  const Rgb above = Rgb(sky_.radiance(Vec3d(local)));
  return in_sun(local) ? above + sun_radiance_ : above;
}

Vec3f SunSky::sample(const Vec2<float>& u) const {
  if (u.x < sun_probability_)
    return normalize(to_world(
        Frame<float>(sun_).to_world(square_to_cone(Vec2<float>{u.x / sun_probability_, u.y}, drawn_one_minus_cos_))));
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

}  // namespace photonproof::inline renderer_lights
