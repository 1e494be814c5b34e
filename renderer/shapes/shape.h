// Functions of all kinds of shapes. Each kind is a struct in a header of its own, listed in surface.h.
//   `hit_distance(shape, ray)`    Where a ray meets it: the smallest t in [t_near, t_far], or a negative value. A ray
//                                 that starts on a curved shape within single precision does not meet it there.
//                                 Neither does one marked as starting or ending on the shape.
//   `point_on(shape, near)`       Its point nearest to `near`, which is close to it.
//   `box_around(shape)`           A box that encloses it; empty for an infinite shape.
//   `local_geometry(shape, frame, p, normal)`   At its point p; `frame` maps its own space, where it is of unit size,
//                                 to the world's.
//   `disc_area(shape, p, radius)` The point p is on it. Area of the part whose photons a gather counts: within the
//                                 radius and accepted by the surface side's test (surface_side.h). Dividing by it
//                                 instead of the full disc removes most of the darkening along edges.
//   `curvature_radius()`          The least radius of curvature; infinite where it is flat.
//   `is_round`                    Whether it is curved so that a ray meets its front once.
//   `sees_itself(both_sides)`     Whether light that leaves its front, or both sides, can meet it again.
//   `placed(description, place)`  The description's shape in the compiled scene.
//   `extent_of(description, to_world)`, `nearest_on(description, to_world, to)`   The box around it and its
//                                 point nearest to another, before there is a compiled scene.
// A missing function is a compile error. Parallelograms, meshes and curves, which Embree intersects, do not need the
// first two.
// Distances are computed in double precision: in single the discriminant of a distant or grazing ray loses all its
// digits.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/core/ray.h"
#include "renderer/shapes/affine_map.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_shapes {

struct Extent;
struct ShapePlace;
template <class Shape>
struct PlacedShape;

/// Known facts about a ray's ends, which rounding cannot decide. The shape is the light that the ray leaves, or the
/// light where it ends at t = 1, on the front.
enum class OnLight { no, starts, ends };

struct ShapeRay {
  Vec3d origin, direction;  ///< direction of any length
  double t_near = 0, t_far = 0;
  OnLight on_light = OnLight::no;
};

/// Result of hit_distance for a ray that does not meet the shape.
inline constexpr double shape_missed = -1;

/// A point of the shape and the unit normal there, on the shape's front side.
struct ShapePoint {
  Vec3f p, normal;
};

/// Empty until something is added.
struct ShapeBox {
  Vec3f low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
  void add(const Vec3f& p);
  void add(const ShapeBox& other);
};

struct LocalGeometry {
  Vec2<float> uv;
  Vec3f dp_du, dp_dv;  ///< 0 where the parameterisation is singular
  Vec3f normal;        ///< for shading: unit, interpolated where the mesh has normals, else the geometric one
};

inline constexpr float flat_curvature = std::numeric_limits<float>::infinity();

/// The parameter where the ray crosses the plane through `point`, if ahead.
inline double plane_distance(const Vec3d& point, const Vec3d& normal, const ShapeRay& ray) {
  const double t = dot(normal, point - ray.origin) / dot(normal, ray.direction);
  return t > 0 && t >= ray.t_near && t <= ray.t_far ? t : shape_missed;  // a NaN, of a parallel ray, is a miss
}

/// The box of these corners, widened by the rounding error.
ShapeBox padded_box(const Vec3d& low, const Vec3d& high);
/// The largest magnitude of a coordinate.
inline double largest_coordinate(const Vec3d& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// Within this distance a ray is on the curved shape that it starts from. It covers the rounding of its origin in
/// single precision, and of the shape, whose numbers are up to `largest`, in double precision.
inline double grain_of_ray(const ShapeRay& ray, double largest) {
  return std::max(0x1p-21 * largest_coordinate(ray.origin), 0x1p-48 * largest) / length(ray.direction);
}

/// Local geometry of a parallelogram or plane with texture coordinates along the frame's first two axes.
inline LocalGeometry local_geometry_of_square(const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  const Vec3f local = frame.local_point(p);
  return {{local.x, local.y}, frame.x, frame.y, normal};
}

}  // namespace photonproof::inline renderer_shapes
