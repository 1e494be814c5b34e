#include "renderer/shapes/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/lanes/warp.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/local_geometry.h"
#include "renderer/shapes/sphere.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_shapes {
namespace {

/// A vector across the curve, of the direction of `offset` where that has one.
Vec3d across(const Vec3d& offset, const Vec3d& along) {
  const double length2 = dot(along, along);
  const Vec3d part = length2 > 0 ? offset - along * (dot(offset, along) / length2) : offset;
  const double norm = length(part);
  if (norm > 0) return part / norm;
  return Vec3d(any_tangents(length2 > 0 ? Vec3f(normalize(along)) : Vec3f(0, 0, 1)).s);
}

/// Directions across the curve from which the angle of u counts, as Mitsuba chooses them.
struct AngleAxes {
  Vec3d start, side;  ///< at u = 0 and 1/4; unit
};
AngleAxes angle_axes(const Vec3d& tangent, const Vec3d& guide) {
  const Vec3d part = guide - tangent * dot(tangent, guide);
  const double norm = length(part);
  const Vec3d side = norm > 0 ? part / norm : Vec3d(0, 1, 0);
  return {cross(side, tangent), side};
}

/// Derivative by the parameter of the direction `radial`, whose angle stays.
Vec3d turning(const CurveFrame& at, const Vec3d& tangent, const Vec3d& guide, const AngleAxes& axes,
              const Vec3d& radial) {
  const Vec3d part = guide - tangent * dot(tangent, guide);
  const double norm = length(part);
  if (!(norm > 0)) return Vec3d(0.0);
  const Vec3d d_tangent = (at.bend - tangent * dot(tangent, at.bend)) / length(at.along);
  const Vec3d d_part = -(d_tangent * dot(tangent, guide) + tangent * dot(d_tangent, guide));
  const Vec3d d_side = (d_part - axes.side * dot(axes.side, d_part)) / norm;
  const Vec3d d_start = cross(d_side, tangent) + cross(axes.side, d_tangent);
  return d_start * dot(radial, axes.start) + d_side * dot(radial, axes.side);
}

}  // namespace

CurveFrame curve_frame(const Curves& curves, std::size_t segment, double v) {
  const CurvePoint* q = &curves.points[curves.segments[segment]];
  const auto sum = [&](const std::array<double, 4>& weights) {
    CurveFrame part{};
    for (std::size_t i = 0; i < curves.points_of_segment(); ++i) {
      part.center += Vec3d(q[i].p) * weights[i];
      part.radius += double{q[i].radius} * weights[i];
    }
    return part;
  };
  if (curves.linear) {
    const CurveFrame at = sum({1 - v, v}), slope = sum({-1, 1});
    return {at.center, slope.center, Vec3d(0.0), at.radius, slope.radius};
  }
  const double w = 1 - v, v2 = v * v, w2 = w * w;
  const CurveFrame at = sum({w2 * w / 6, (3 * v2 * v - 6 * v2 + 4) / 6, (3 * w2 * w - 6 * w2 + 4) / 6, v2 * v / 6});
  const CurveFrame slope = sum({-w2 / 2, (3 * v2 - 4 * v) / 2, (4 * w - 3 * w2) / 2, v2 / 2});
  const CurveFrame second = sum({w, 3 * v - 2, 3 * w - 2, v});
  return {at.center, slope.center, second.center, at.radius, slope.radius};
}

// A ball of a linear segment touches the envelope where the offset from its centre is the normal. Embree's parameter is
// that of this ball, also at the round ends. The surface of a B-spline is c + r n, n a unit vector across c'. By the
// product rule its normal is ((c'.c' - r n.c'') n - r' c') up to a factor.
ShapePoint point_on(const Curves& curves, std::size_t segment, double v, const Vec3d& near) {
  const CurveFrame at = curve_frame(curves, segment, v);
  const Vec3d offset = near - at.center;
  Vec3d out, normal;
  if (curves.linear) {
    const double norm = length(offset);
    out = normal = norm > 0 ? offset / norm : across(offset, at.along);
  } else {
    out = across(offset, at.along);
    const Vec3d n = out * (dot(at.along, at.along) - at.radius * dot(out, at.bend)) - at.along * at.widening;
    const double norm = length(n);
    normal = norm > 0 ? n / norm : out;
  }
  return {Vec3f(at.center + out * at.radius), Vec3f(curves.inward ? -normal : normal)};
}

// On a segment, p - r(v) n = c(v) is linear in v. On a B-spline p - c(v) is across c'(v). Of several such v that counts
// whose radius fits best.
double curve_parameter(const Curves& curves, std::size_t segment, const Vec3d& p, const Vec3d& normal) {
  if (curves.linear) {
    const CurveFrame start = curve_frame(curves, segment, 0);
    const Vec3d outward = curves.inward ? -normal : normal;
    const Vec3d direction = start.along + outward * start.widening;
    const double length2 = dot(direction, direction);
    const double v = length2 > 0 ? dot(p - outward * start.radius - start.center, direction) / length2 : 0;
    return std::clamp(v, 0.0, 1.0);
  }
  constexpr int starts = 8, steps = 12;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < starts; ++i) {
    double v = (i + 0.5) / starts;
    for (int step = 0; step < steps; ++step) {
      const CurveFrame at = curve_frame(curves, segment, v);
      const Vec3d offset = p - at.center;
      const double slope = dot(offset, at.bend) - dot(at.along, at.along);
      if (!(slope < 0)) break;
      v = std::clamp(v - dot(offset, at.along) / slope, 0.0, 1.0);
    }
    const CurveFrame at = curve_frame(curves, segment, v);
    const Vec3d offset = p - at.center;
    const double off =
        std::abs(length(offset) - at.radius) + std::abs(dot(offset, at.along)) / std::max(length(at.along), 1e-300);
    if (off < least) {
      least = off;
      best = v;
    }
  }
  return best;
}

ShapeBox box_around(const Curves& curves) {
  ShapeBox box;
  for (const CurvePoint& q : curves.points) {
    const Vec3f reach(q.radius);
    box.add({q.p - reach, q.p + reach});
  }
  return box;
}

LocalGeometry local_geometry(const Curves& curves, std::uint32_t segment, const Vec3f& p, const Vec3f& normal) {
  const double v = curve_parameter(curves, segment, Vec3d(p), Vec3d(normal));
  const CurveFrame at = curve_frame(curves, segment, v);
  const Vec3d offset = Vec3d(p) - at.center;
  const double along = length(at.along), from_center = length(offset);
  if (!(along > 0 && from_center > 0)) {
    const Tangents around = any_tangents(normal);
    return {{0, 0}, around.s, around.t, normal};
  }
  const Vec3d tangent = at.along / along, radial = offset / from_center;
  const AngleAxes axes = angle_axes(tangent, curves.guide);
  const double count = static_cast<double>(curves.segments.size());
  Vec3d dp_dv = at.along + radial * at.widening;
  if (!curves.linear) dp_dv += turning(at, tangent, curves.guide, axes, radial) * at.radius;
  const float u = turn_of(static_cast<float>(dot(radial, axes.start)), static_cast<float>(dot(radial, axes.side)));
  return {{u, static_cast<float>((v + segment) / count)},
          Vec3f(cross(tangent, offset) * (2 * double{pi})),
          Vec3f(dp_dv * count),
          normal};
}

Curves compiled_curves(const CurvesDescription& description, const Transform& to_world, const Transform& of_instance,
                       bool inward) {
  const CurveSet& source = *description.curves;
  Curves made;
  made.linear = description.basis == CurvesDescription::Basis::linear;
  made.inward = inward;
  made.guide = normalize(of_instance.vector({0, 0, 1}));
  const double radius_scale = description.radius_scale * of_instance.similarity_scale();
  made.points.reserve(source.points.size());
  for (const CurvePoint& q : source.points)
    made.points.push_back({Vec3f(to_world.point(Vec3d(q.p))), static_cast<float>(double{q.radius} * radius_scale)});
  for (std::size_t i = 0; i < source.first.size(); ++i) {
    const std::size_t end = i + 1 < source.first.size() ? source.first[i + 1] : source.points.size();
    for (std::size_t first = source.first[i]; first + made.points_of_segment() <= end; ++first)
      made.segments.push_back(static_cast<std::uint32_t>(first));
  }
  return made;
}

Extent extent_of(const CurvesDescription& description, const Transform& to_world) {
  Extent extent;
  for (const CurvePoint& q : description.curves->points) {
    const Vec3d p = to_world.point(Vec3d(q.p)), reach(double{q.radius} * description.radius_scale);
    extent.add(p - reach);
    extent.add(p + reach);
  }
  return extent;
}

Vec3d nearest_on(const CurvesDescription& description, const Transform& to_world, const Vec3d& to) {
  Vec3d nearest(0.0);
  double least = std::numeric_limits<double>::infinity();
  for (const CurvePoint& q : description.curves->points) {
    const Vec3d p = nearest_on_ball(to_world.point(Vec3d(q.p)), double{q.radius} * description.radius_scale, to);
    if (const double distance2 = length_squared(p - to); distance2 < least) {
      least = distance2;
      nearest = p;
    }
  }
  return nearest;
}

}  // namespace photonproof::inline renderer_shapes
