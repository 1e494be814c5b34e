#include "renderer/scene_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace photonproof {
namespace {

struct Extent {
  Vec3d low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const Vec3d& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

Extent extent_of(const ShapeDescription& shape) {
  Extent extent;
  if (const auto* sphere = std::get_if<SphereDescription>(&shape.geometry)) {
    const Vec3d center = shape.to_world.point(sphere->center);
    const Vec3d reach(sphere->radius * shape.to_world.similarity_scale());
    extent.add(center - reach);
    extent.add(center + reach);
  } else if (const auto* ply = std::get_if<MeshDescription>(&shape.geometry)) {
    for (const Vec3f& p : ply->mesh->positions) extent.add(shape.to_world.point(Vec3d(p)));
  } else {
    const bool flat = std::holds_alternative<RectangleDescription>(shape.geometry);
    for (int corner = 0; corner < 8; ++corner) {
      const auto sign = [&](int bit) { return (corner >> bit & 1) != 0 ? 1.0 : -1.0; };
      extent.add(shape.to_world.point({sign(0), sign(1), flat ? 0.0 : sign(2)}));
    }
  }
  return extent;
}

/// The mean of the two middle ones of an even number.
double median(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

SceneFrame scene_frame(const SceneDescription& description) {
  std::vector<Extent> extents;
  for (const ShapeDescription& shape : description.shapes) {
    const Extent extent = extent_of(shape);
    if (is_finite(extent.low) && is_finite(extent.high)) extents.push_back(extent);
  }
  if (extents.empty()) return {};

  std::vector<double> x, y, z, reach;
  for (const Extent& e : extents) {
    const Vec3d middle = (e.low + e.high) * 0.5;
    x.push_back(middle.x);
    y.push_back(middle.y);
    z.push_back(middle.z);
  }
  // Whole floats, so that adding it to what is near it loses nothing that matters.
  const Vec3d origin(Vec3f(Vec3d(median(x), median(y), median(z))));
  if (!is_finite(origin)) return {};
  for (const Extent& e : extents) {
    const Vec3d low = e.low - origin, high = e.high - origin;
    reach.push_back(std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z}));
  }
  return {-origin, static_cast<float>(median(reach) / 16)};
}

}  // namespace photonproof
