// Where a finite light is, where to it shines and how strongly: what choosing it by position needs to know (Conty
// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", section 4).
#pragma once

#include <optional>
#include <vector>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {

/// Light leaves in directions within `spread` + `emission` of the axis: normals are within `spread` of it, and light
/// within `emission` of a normal. Radians.
struct LightBounds {
  Vec3f low, high;
  Vec3f axis{0, 0, 1};
  float spread = pi, emission = pi / 2;
  float power = 0;  ///< mean channel of the flux, W
};

/// Without their power: of a Lambertian parallelogram or ellipse (center + a half_axis_u + b half_axis_v), and of what
/// is in a box and has normals on all sides.
LightBounds parallelogram_bounds(const Vec3f& corner, const Vec3f& edge_u, const Vec3f& edge_v, const Vec3f& normal);
LightBounds ellipse_bounds(const Vec3f& center, const Vec3f& half_axis_u, const Vec3f& half_axis_v,
                           const Vec3f& normal);
LightBounds round_bounds(const Vec3f& low, const Vec3f& high);
LightBounds round_bounds(const std::vector<Vec3f>& points);  ///< in the box around them

/// Of a triangle that emits to the side of its normal, its area being its power; nothing if it has none.
std::optional<LightBounds> triangle_bounds(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& normal,
                                           float area);
/// Of both together.
LightBounds merge(const LightBounds& a, const LightBounds& b);

/// How much of the light within bounds arrives at a point, without trigonometry: a descent asks ten times and more.
class LightImportance {
 public:
  LightImportance() = default;
  explicit LightImportance(const LightBounds& bounds);
  /// Up to a factor: power x cos / distance^2. 0 only where no light can arrive.
  float at(const Vec3f& p) const;

 private:
  /// Of angles' rounding: a single-precision cosine near 1 knows its angle to 5e-4, and four of them enter.
  static constexpr float slack = 2e-3f;
  Vec3f center_, axis_;
  float radius_ = 0, power_ = 0;
  float cos_spread_ = -1, sin_spread_ = 0;  ///< with the slack
  float cos_emission_ = -1;
};

}  // namespace photonproof::inline renderer_lights
