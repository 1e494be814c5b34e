#include "renderer/lights/sky_envmap.h"

#include <algorithm>
#include <cmath>

#include "renderer/lanes/lane_trig.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {
namespace {

double magnitude(const Rgb& rgb) { return (std::abs(double{rgb.x}) + std::abs(rgb.y) + std::abs(rgb.z)) / 3; }

}  // namespace

EnvmapSky::EnvmapSky(const Image& image, float scale, const Transform& to_world)
    : width_(image.width),
      height_(image.height),
      rgb_(image.rgb),
      x_(normalize(to_world.vector({1, 0, 0}))),
      y_(normalize(to_world.vector({0, 1, 0}))),
      z_(normalize(to_world.vector({0, 0, 1}))) {
  for (float& v : rgb_) v *= scale;
  // A cell between four texels is chosen by the mean of their magnitudes times its solid angle, then sampled uniformly.
  std::vector<double> row_weights;
  RgbD total(0.0);
  for (int row = 0; row < rows(); ++row) {
    const double per_texel = solid_angle(row) / 4;
    std::vector<double> weights;
    for (int column = 0; column < width_; ++column) {
      double weight = 0;
      for (const int r : {row, row + 1})
        for (const int c : {column, column + 1}) weight += magnitude(texel(c, r)) * per_texel;
      weights.push_back(weight);
    }
    // The sine weights the two rows of a cell differently: linear in the angle, integrated exactly.
    const double top = row * pi_d / rows(), bottom = (row + 1) * pi_d / rows(), width = bottom - top;
    const double lower = (std::sin(bottom) - std::sin(top)) / width - std::cos(bottom);
    const double upper = std::cos(top) - std::cos(bottom) - lower;
    for (int column = 0; column < width_; ++column) {
      total += RgbD(texel(column, row)) * (upper * 2 * pi_d / width_);
      total += RgbD(texel(column, row + 1)) * (lower * 2 * pi_d / width_);
    }
    in_row_.emplace_back(weights);
    row_weights.push_back(in_row_.back().total());
  }
  by_row_ = DiscreteDistribution(row_weights);
  irradiance_ = Rgb(total);
}

Rgb EnvmapSky::radiance(const Vec3f& towards_sky) const {
  const Place at = place_of({dot(towards_sky, x_), dot(towards_sky, y_), dot(towards_sky, z_)});
  const Rgb upper = texel(at.column, at.row) * (1 - at.right) + texel(at.column + 1, at.row) * at.right;
  const Rgb lower = texel(at.column, at.row + 1) * (1 - at.right) + texel(at.column + 1, at.row + 1) * at.right;
  return upper * (1 - at.down) + lower * at.down;
}

Vec3f EnvmapSky::sample(const Vec2<float>& u) const {
  const DiscreteDistribution::Drawn row = by_row_.sample(u.x);
  const DiscreteDistribution::Drawn column = in_row_[row.index].sample(u.y);
  const double top = std::cos(static_cast<double>(row.index) * pi_d / rows());
  const double bottom = std::cos(static_cast<double>(row.index + 1) * pi_d / rows());
  const double up = top + (bottom - top) * double{row.u};
  const double across = std::sqrt(std::max(0.0, 1 - up * up));
  const double phi = (static_cast<double>(column.index) + double{column.u} + 0.5) * 2 * pi_d / width_;
  return normalize(x_ * static_cast<float>(across * std::sin(phi)) + y_ * static_cast<float>(up) -
                   z_ * static_cast<float>(across * std::cos(phi)));
}

float EnvmapSky::pdf(const Vec3f& towards_sky) const {
  const Place at = place_of({dot(towards_sky, x_), dot(towards_sky, y_), dot(towards_sky, z_)});
  const auto row = static_cast<std::size_t>(at.row);
  const float probability = by_row_.probability(row) * in_row_[row].probability(static_cast<std::size_t>(at.column));
  return static_cast<float>(double{probability} / solid_angle(at.row));
}

EnvmapSky::Place EnvmapSky::place_of(const Vec3f& local) const {
  const float across = std::hypot(local.x, local.z);
  const float y = angle_of(across, local.y) * static_cast<float>(rows() / pi_d);
  float x = std::atan2(local.x, -local.z) * static_cast<float>(width_ / (2 * pi_d)) - 0.5f;
  if (x < 0) x += static_cast<float>(width_);
  const int column = std::clamp(static_cast<int>(x), 0, width_ - 1);
  const int row = std::clamp(static_cast<int>(y), 0, rows() - 1);
  return {column, row, std::clamp(x - static_cast<float>(column), 0.0f, 1.0f),
          std::clamp(y - static_cast<float>(row), 0.0f, 1.0f)};
}

Rgb EnvmapSky::texel(int column, int row) const {
  if (column >= width_) column -= width_;
  const float* p =
      &rgb_[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column))];
  return {p[0], p[1], p[2]};
}

double EnvmapSky::solid_angle(int row) const {
  return (std::cos(row * pi_d / rows()) - std::cos((row + 1) * pi_d / rows())) * 2 * pi_d / width_;
}

}  // namespace photonproof::inline renderer_lights
