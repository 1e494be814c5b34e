#include "renderer/areas/solid_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace photonproof::inline renderer_areas {
namespace {

/// Footprints of balls are polygons whose corners lie 0.08 % outside the circle.
constexpr double around_footprints = 1.01;

struct DoubleBox {
  Vec3d middle, half;

  explicit DoubleBox(const ShapeBox& box)
      : middle((Vec3d(box.low) + Vec3d(box.high)) / 2), half((Vec3d(box.high) - Vec3d(box.low)) / 2) {}
  double reach_along(const Vec3d& n) const {
    return std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
  }
};

/// Reach of the solid with its touching distance, and with room for rounding.
double widened(const Solid& solid, double reach) { return around_footprints * reach + 2 * solid.grain(); }

ShapeBox box_around_corners(const Quad& quad) {
  const Vec3d corner(quad.corner), u(quad.edge_u), v(quad.edge_v);
  Vec3d low = corner, high = corner;
  for (const Vec3d& p : {corner + u, corner + v, corner + u + v}) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return padded_box(low, high);
}

ShapeBox everywhere() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {Vec3f(-infinity), Vec3f(infinity)};
}

}  // namespace

SolidBounds::SolidBounds(const Solid& solid) : middle_(solid.middle), radius_(widened(solid, solid.radius)) {
  const Vec3d reach{widened(solid, solid.reach_along({1, 0, 0})), widened(solid, solid.reach_along({0, 1, 0})),
                    widened(solid, solid.reach_along({0, 0, 1}))};
  box_ = padded_box(solid.middle - reach, solid.middle + reach);
  if (solid.radius > 0) return;
  radius_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slabs_.size(); ++i) {
    const Vec3d normal = normalize(cross(solid.half_edges[(i + 1) % 3], solid.half_edges[(i + 2) % 3]));
    if (is_finite(normal)) slabs_[i] = {normal, widened(solid, std::abs(dot(normal, solid.half_edges[i])))};
  }
}

bool SolidBounds::meets(const ShapeBox& box) const {
  if (!boxes_meet(box_, box)) return false;
  const DoubleBox other(box);
  const Vec3d apart = other.middle - middle_;
  if (radius_ < std::numeric_limits<double>::infinity()) {
    const auto beyond = [](double distance, double half) { return std::max(0.0, std::abs(distance) - half); };
    const Vec3d nearest{beyond(apart.x, other.half.x), beyond(apart.y, other.half.y), beyond(apart.z, other.half.z)};
    return !(length_squared(nearest) > radius_ * radius_);
  }
  return std::ranges::none_of(slabs_, [&](const Slab& slab) {
    return std::abs(dot(slab.normal, apart)) > slab.half + other.reach_along(slab.normal);
  });
}

FlatBounds::FlatBounds(const Quad& quad)
    : box_(box_around_corners(quad)), normal_(normalize(Vec3d(quad.normal))), point_(quad.corner) {}

FlatBounds::FlatBounds(const renderer_shapes::Plane& plane)
    : box_(everywhere()), normal_(plane.normal), point_(plane.point) {}

bool FlatBounds::meets(const ShapeBox& box) const {
  if (!boxes_meet(box_, box)) return false;
  const DoubleBox other(box);
  return !(std::abs(dot(normal_, other.middle - point_)) > other.reach_along(normal_));
}

}  // namespace photonproof::inline renderer_areas
