// What the kinds of shapes are asked. Each is a struct in a header of its own, which surface.h lists, with
//   hit_distance(shape, ray)      where a ray meets it: the smallest t in [t_near, t_far], or a negative value. A ray
//                                 that starts on a curved shape as far as single precision can tell does not meet it
//                                 there, nor one that is said to start or to end on the shape
//   point_on(shape, near)         its point nearest to `near`, which is close to it
//   box_around(shape)             a box that holds it; of an infinite shape an empty one
//   local_geometry(shape, frame, p, normal)   at its point p; `frame` maps its own space, where it is of unit size, to
//                                 the world's
//   disc_area(shape, p, radius)   p on it: the area of the part of it whose photons a gather counts, those within the
//                                 radius that pass the surface side's test (photon_sheet.h). Dividing by it instead of
//                                 the full disc removes most of the darkening along edges
//   curvature_radius()            the least radius of curvature; infinite where it is flat
//   is_round                      whether it is curved so that a ray meets its front once
//   sees_itself(both_sides)       whether light that leaves its front, or both sides, can meet it again
//   placed(description, place)    what the description's shape is in the compiled scene
//   extent_of(description, to_world), nearest_on(description, to_world, to)   the box around it and its point nearest
//                                 to another, before there is a compiled scene
// The compiler asks for what is missing. Parallelograms and meshes, which Embree knows, need not have the first two.
// Distances are worked out in double precision: in single the discriminant of a distant or grazing ray loses all its
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

/// What is known of a ray, whatever single precision makes of its ends: that the shape it is asked of is the light that
/// it leaves, or the light where it ends at t = 1, on the front.
enum class OnLight { no, starts, ends };

struct ShapeRay {
  Vec3d origin, direction;  ///< direction of any length
  double t_near = 0, t_far = 0;
  OnLight on_light = OnLight::no;
};

/// What hit_distance says of a ray that does not meet the shape.
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

/// The box of these corners and what rounding could leave outside.
ShapeBox padded_box(const Vec3d& low, const Vec3d& high);
/// The largest magnitude of a coordinate.
inline double largest_coordinate(const Vec3d& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// Nearer than this a ray is on the curved shape that it starts from: what single precision loses of its origin, and
/// double precision of the shape, whose numbers are up to `largest`.
inline double grain_of_ray(const ShapeRay& ray, double largest) {
  return std::max(0x1p-21 * largest_coordinate(ray.origin), 0x1p-48 * largest) / length(ray.direction);
}

/// Of a parallelogram or a plane with texture coordinates along the frame's first two axes.
inline LocalGeometry local_geometry_of_square(const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  const Vec3f local = frame.local_point(p);
  return {{local.x, local.y}, frame.x, frame.y, normal};
}

}  // namespace photonproof::inline renderer_shapes
