#include "renderer/lights/light_ies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// The interval of `angles`, at least two and ascending, that contains `angle`, and the fraction within it.
std::pair<std::size_t, double> locate(const std::vector<double>& angles, double angle) {
  const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
  const auto index = static_cast<std::size_t>(above - angles.begin()) - 1;
  const double width = angles[index + 1] - angles[index];
  return {index, width > 0 ? std::clamp((angle - angles[index]) / width, 0.0, 1.0) : 0.0};
}

/// Integral of f(t) sin(t) over [t0, t1] for f linear from f0 to f1.
double linear_times_sine(double t0, double t1, double f0, double f1) {
  const double slope = t1 > t0 ? (f1 - f0) / (t1 - t0) : 0;
  return f0 * std::cos(t0) - f1 * std::cos(t1) + slope * (std::sin(t1) - std::sin(t0));
}

}  // namespace

IesLight::IesLight(const Vec3f& position, const Vec3f& c0, const Vec3f& c90, const Vec3f& zenith, const Rgb& intensity,
                   const IesProfile& profile)
    : position_(position),
      c0_(c0),
      c90_(c90),
      zenith_(zenith),
      intensity_(intensity),
      vertical_(profile.vertical_degrees) {
  // The file's planes, mirrored until they cover all azimuths.
  const std::size_t rows = vertical_.size();
  const auto& planes = profile.horizontal_degrees;
  const auto add_plane = [&](double degrees, std::size_t plane) {
    horizontal_.push_back(degrees);
    const auto from = profile.candela.begin() + static_cast<std::ptrdiff_t>(plane * rows);
    candela_.insert(candela_.end(), from, from + static_cast<std::ptrdiff_t>(rows));
  };
  for (std::size_t i = 0; i < planes.size(); ++i) add_plane(planes[i], i);
  const auto mirror_about = [&](double degrees) {
    for (std::size_t i = horizontal_.size() - 1; i-- > 0;) {
      horizontal_.push_back(2 * degrees - horizontal_[i]);
      for (std::size_t row = 0; row < rows; ++row) candela_.push_back(candela_[i * rows + row]);
    }
  };
  if (planes.size() == 1) add_plane(360, 0);
  if (horizontal_.back() == 90) mirror_about(90);
  if (horizontal_.back() == 180) mirror_about(180);
  if (horizontal_.back() < 360) add_plane(360, 0);  // the gap to the first plane

  std::vector<double> fluxes;
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (std::size_t column = 0; column < columns(); ++column) {
      const auto mean = [&](std::size_t at) {
        return (candela_[column * rows + at] + candela_[(column + 1) * rows + at]) / 2;
      };
      const double width = (horizontal_[column + 1] - horizontal_[column]) * radians;
      fluxes.push_back(
          width * linear_times_sine(vertical_[row] * radians, vertical_[row + 1] * radians, mean(row), mean(row + 1)));
    }
  if (fluxes.empty()) fluxes.push_back(0);
  cells_ = DiscreteDistribution(fluxes);
  flux_ = intensity_ * static_cast<float>(cells_.total());
}

LightSample<float> IesLight::sample(const Vec3f& p, const Vec2<float>&) const {
  const Vec3f d = position_ - p;
  const float inverse = 1 / length(d);
  const Vec3f wi = d * inverse;
  const auto towards = dot(d, d) > 0 ? static_cast<float>(candela_towards(-wi)) : 0.0f;
  return {{position_}, wi, intensity_ * (towards * inverse * inverse), towards > 0 ? 1.0f : 0.0f};
}

Emission<float> IesLight::emit(const Vec2<float>&, const Vec2<float>& u) const {
  if (!(cells_.total() > 0)) return {{position_}, zenith_, Rgb(0.0f)};
  const DiscreteDistribution::Drawn drawn = cells_.sample(u.x);
  const std::size_t row = drawn.index / columns(), column = drawn.index % columns();
  const double top = std::cos(vertical_[row] * radians), bottom = std::cos(vertical_[row + 1] * radians);
  const double down = top + (bottom - top) * double{drawn.u};  // cosine of the angle to the nadir
  const double phi = (horizontal_[column] + (horizontal_[column + 1] - horizontal_[column]) * double{u.y}) * radians;
  const double across = std::sqrt(std::max(0.0, 1 - down * down));
  const Vec3f direction = c0_ * static_cast<float>(across * std::cos(phi)) +
                          c90_ * static_cast<float>(across * std::sin(phi)) - zenith_ * static_cast<float>(down);
  const double pdf = double{drawn.probability} / solid_angle(drawn.index);
  const auto carried = static_cast<float>(candela_towards(direction) / pdf);
  return {{position_}, direction, intensity_ * carried};
}

EmissionPdfs<float> IesLight::emit_pdfs(const LightPoint<float>&, const Vec3f& direction) const {
  if (!(cells_.total() > 0)) return {1, 0};
  const double vertical = angle_between(Vec3f(-zenith_), direction) / radians;
  if (vertical < vertical_.front() || vertical > vertical_.back()) return {1, 0};
  double horizontal = std::atan2(dot(direction, c90_), dot(direction, c0_)) / radians;
  if (horizontal < 0) horizontal += 360;
  const std::size_t cell = cell_of(locate(vertical_, vertical).first, locate(horizontal_, horizontal).first);
  return {1, static_cast<float>(double{cells_.probability(cell)} / solid_angle(cell))};
}

Rgb IesLight::leaving(const LightPoint<float>&, const Vec3f& direction) const {
  return intensity_ * static_cast<float>(candela_towards(direction));
}

double IesLight::solid_angle(std::size_t cell) const {
  const std::size_t row = cell / columns(), column = cell % columns();
  return (std::cos(vertical_[row] * radians) - std::cos(vertical_[row + 1] * radians)) *
         (horizontal_[column + 1] - horizontal_[column]) * radians;
}

double IesLight::candela(double vertical, double horizontal) const {
  if (vertical_.size() < 2 || vertical < vertical_.front() || vertical > vertical_.back()) return 0;
  const auto [row, down] = locate(vertical_, vertical);
  const auto [column, around] = locate(horizontal_, horizontal);
  const auto at = [&](std::size_t c, std::size_t r) { return candela_[c * vertical_.size() + r]; };
  const double near = at(column, row) * (1 - down) + at(column, row + 1) * down;
  const double far = at(column + 1, row) * (1 - down) + at(column + 1, row + 1) * down;
  return near * (1 - around) + far * around;
}

double IesLight::candela_towards(const Vec3f& direction) const {
  const double vertical = angle_between(Vec3f(-zenith_), direction) / radians;
  double horizontal = std::atan2(dot(direction, c90_), dot(direction, c0_)) / radians;
  if (horizontal < 0) horizontal += 360;
  return candela(vertical, horizontal);
}

}  // namespace photonproof::inline renderer_lights
