// Tubes around curves: B-splines with open ends, or polylines with round joints and ends. Their surfaces are Embree's:
// circles across a B-spline, and the envelope of the balls along a segment of a polyline.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/shapes/shape.h"
#include "scenes/curves/curve_set.h"

namespace photonproof::inline scenes_description {
struct CurvesDescription;
}

namespace photonproof::inline renderer_shapes {

/// All curves of one shape. A segment is a pair of control points, or four of a B-spline, of which it is the middle
/// part.
struct Curves {
  std::vector<CurvePoint> points;       ///< in world space
  std::vector<std::uint32_t> segments;  ///< the first control point of each
  bool linear = false;
  bool inward = false;   ///< the normal points to the curve
  Vec3d guide{0, 0, 1};  ///< unit; u is a quarter on this side of a tube

  static constexpr bool is_round = false;
  float curvature_radius() const { return 0; }
  bool sees_itself(bool) const { return true; }
  std::size_t points_of_segment() const { return linear ? 2 : 4; }
};

/// A curve at a parameter in [0, 1] of a segment, with derivatives by the parameter.
struct CurveFrame {
  Vec3d center, along, bend;  ///< the point, its first and its second derivative
  double radius, widening;    ///< the radius and its derivative
};
CurveFrame curve_frame(const Curves& curves, std::size_t segment, double v);

/// The surface's point at the parameter `v` that a ray met near `near`.
ShapePoint point_on(const Curves& curves, std::size_t segment, double v, const Vec3d& near);
/// The parameter of a point of the segment's surface with this normal.
double curve_parameter(const Curves& curves, std::size_t segment, const Vec3d& p, const Vec3d& normal);

ShapeBox box_around(const Curves& curves);
LocalGeometry local_geometry(const Curves& curves, std::uint32_t segment, const Vec3f& p, const Vec3f& normal);
/// `of_instance`, a similarity, is the part of to_world that is not the shape's own. It scales radii, and turns the
/// direction from which u counts.
Curves compiled_curves(const CurvesDescription& description, const Transform& to_world, const Transform& of_instance,
                       bool inward);
Extent extent_of(const CurvesDescription& description, const Transform& to_world);
/// On the ball around a control point.
Vec3d nearest_on(const CurvesDescription& description, const Transform& to_world, const Vec3d& to);

}  // namespace photonproof::inline renderer_shapes
