#include "renderer/textures/volume.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline renderer_textures {
namespace {

/// From the unit cube over which the value is given to the frame of rays.
Transform from_unit_cube(const VolumeColour& value, const VolumeFrame& frame) {
  Transform placed = Transform::translate(frame.moved) * Transform::scale(Vec3d(frame.scale)) * place_of(value);
  const auto* grid = std::get_if<GridVolumeDescription>(&value);
  if (grid != nullptr && grid->use_grid_bbox) {
    const Vec3d low(grid->grid->low), high(grid->grid->high);
    placed = placed * Transform::translate(low) * Transform::scale(high - low);
  }
  return placed;
}

constexpr float most_index = 1 << 30;

std::array<float, 3> by_axis(const Vec3f& v) { return {v.x, v.y, v.z}; }

float bounded(float x) { return x > -most_index ? std::min(x, most_index) : -most_index; }  // NaN, too

}  // namespace

Volume::Volume(const VolumeColour& value, const VolumeFrame& frame) {
  const Transform placed = from_unit_cube(value, frame), map = *placed.inverse();  // the parser refuses others
  Vec3d low = placed.point({0, 0, 0}), high = low;
  for (const int corner : {1, 2, 3, 4, 5, 6, 7}) {
    const Vec3d p = placed.point(Vec3d(corner & 1, corner >> 1 & 1, corner >> 2));
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  low_ = Vec3f(low);
  high_ = Vec3f(high);
  for (std::size_t row = 0; row < 3; ++row)
    axes_[row] = Vec3f(Vec3d(map.m[4 * row], map.m[4 * row + 1], map.m[4 * row + 2]));
  offset_ = Vec3f(Vec3d(map.m[3], map.m[7], map.m[11]));
  if (const RgbD* constant = constant_of(value)) {
    constant_ = Rgb(*constant);
    return;
  }
  const auto& grid = std::get<GridVolumeDescription>(value);
  grid_ = grid.grid;
  filter_ = grid.filter;
  wrap_ = grid.wrap;
}

Vec3f Volume::local_point(const Vec3f& p) const {
  return Vec3f(dot(axes_[0], p), dot(axes_[1], p), dot(axes_[2], p)) + offset_;
}

Volume::Span Volume::inside(const Vec3f& origin, const Vec3f& direction, float distance) const {
  const std::array<float, 3> low = by_axis(low_ - origin), high = by_axis(high_ - origin), along = by_axis(direction);
  Span span{0, distance};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0) {
      if (low[axis] > 0 || high[axis] < 0) return {0, 0};
      continue;
    }
    const float at_low = low[axis] / along[axis], at_high = high[axis] / along[axis];
    span.begin = std::max(span.begin, std::min(at_low, at_high));
    span.end = std::min(span.end, std::max(at_low, at_high));
  }
  return span;
}

int Volume::wrapped(int i, int cells) const {
  if (wrap_ == TextureWrap::clamp) return std::clamp(i, 0, cells - 1);
  const int period = wrap_ == TextureWrap::mirror ? 2 * cells : cells;
  const int at = (i % period + period) % period;
  return at < cells ? at : period - 1 - at;
}

Rgb Volume::cell(const std::array<int, 3>& index) const {
  const auto x = static_cast<std::size_t>(wrapped(index[0], grid_->width)),
             y = static_cast<std::size_t>(wrapped(index[1], grid_->height)),
             z = static_cast<std::size_t>(wrapped(index[2], grid_->depth));
  const auto width = static_cast<std::size_t>(grid_->width), height = static_cast<std::size_t>(grid_->height);
  const std::size_t at = (z * height + y) * width + x;
  const std::vector<float>& values = grid_->values;
  return grid_->channels == 1 ? Rgb(values[at]) : Rgb(values[3 * at], values[3 * at + 1], values[3 * at + 2]);
}

Rgb Volume::at(const Vec3f& p) const {
  if (!grid_) return constant_;
  const std::array<float, 3> local = by_axis(local_point(p));
  const std::array<int, 3> cells = {grid_->width, grid_->height, grid_->depth};
  const bool nearest = filter_ == VolumeFilter::nearest;
  std::array<int, 3> low{};
  std::array<float, 3> part{};  // of the way to the next cell
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float x = bounded(local[axis] * static_cast<float>(cells[axis]) - (nearest ? 0.0f : 0.5f));
    low[axis] = static_cast<int>(std::floor(x));
    part[axis] = x - std::floor(x);
  }
  if (nearest) return cell(low);
  Rgb sum(0.0f);
  for (const int corner : {0, 1, 2, 3, 4, 5, 6, 7}) {
    std::array<int, 3> index = low;
    float share = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int step = corner >> axis & 1;
      index[axis] += step;
      share *= step == 1 ? part[axis] : 1 - part[axis];
    }
    if (share > 0) sum += cell(index) * share;
  }
  return sum;
}

}  // namespace photonproof::inline renderer_textures
