// Bounds of a finite light's position, directions and power, for choosing lights by position. Source: Conty Estevez and
// Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", section 4.
#pragma once

#include <optional>
#include <vector>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {

/// Light leaves in directions within `spread` + `emission` of the axis: normals lie within `spread` of it, and light
/// within `emission` of a normal. Radians.
struct LightBounds {
  Vec3f low, high;
  Vec3f axis{0, 0, 1};
  float spread = pi, emission = pi / 2;
  float power = 0;  ///< mean over channels of the flux, W
};

/// Bounds without power, of a Lambertian parallelogram or ellipse (center + a half_axis_u + b half_axis_v).
/// `round_bounds` are those of shapes in a box with normals on all sides.
LightBounds parallelogram_bounds(const Vec3f& corner, const Vec3f& edge_u, const Vec3f& edge_v, const Vec3f& normal);
LightBounds ellipse_bounds(const Vec3f& center, const Vec3f& half_axis_u, const Vec3f& half_axis_v,
                           const Vec3f& normal);
LightBounds round_bounds(const Vec3f& low, const Vec3f& high);
LightBounds round_bounds(const std::vector<Vec3f>& points);  ///< in the box around them

/// Bounds of a triangle that emits to the side of its normal, with its area as power; empty for an area of 0.
std::optional<LightBounds> triangle_bounds(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& normal,
                                           float area);
/// Bounds of both together.
LightBounds merge(const LightBounds& a, const LightBounds& b);

/// Share of the bounded light that arrives at a point, without trigonometry: a descent evaluates this at least ten
/// times.
class LightImportance {
 public:
  LightImportance() = default;
  explicit LightImportance(const LightBounds& bounds);
  /// The importance, power x cos / distance^2 up to a factor. It is 0 only where no light can arrive.
  float at(const Vec3f& p) const;

 private:
  /// Margin for rounded angles: a single-precision cosine near 1 has an error of 5e-4 in the angle, and four of them
  /// enter.
  static constexpr float slack = 2e-3f;
  Vec3f center_, axis_;
  float radius_ = 0, power_ = 0;
  float cos_spread_ = -1, sin_spread_ = 0;  ///< with the slack
  float cos_emission_ = -1;
};

}  // namespace photonproof::inline renderer_lights
