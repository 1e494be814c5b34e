// Where rays meet the shapes that Embree does not know: spheres, discs, cylinders, planes, and faces too long for it.
// Double precision: in single the discriminant of a distant or grazing ray loses all its digits.
#pragma once

#include "renderer/shapes/surface.h"

namespace photonproof {

struct ShapeRay {
  Vec3d origin, direction;  ///< direction of any length
  double t_near = 0, t_far = 0;
};

/// The smallest t in [t_near, t_far] where the ray meets the shape, or a negative value. A ray that starts on a sphere
/// or a cylinder as far as single precision can tell does not meet it there.
double hit_distance(const Sphere& sphere, const ShapeRay& ray);
double hit_distance(const Disk& disk, const ShapeRay& ray);
double hit_distance(const Cylinder& cylinder, const ShapeRay& ray);
double hit_distance(const Plane& plane, const ShapeRay& ray);
double hit_distance(const LongFace& face, const ShapeRay& ray);

/// A point of the shape and the unit normal there, on the shape's front side.
struct ShapePoint {
  Vec3f p, normal;
};
/// The shape's point nearest to `near`, which is close to it.
ShapePoint point_on(const Sphere& sphere, const Vec3d& near);
ShapePoint point_on(const Disk& disk, const Vec3d& near);
ShapePoint point_on(const Cylinder& cylinder, const Vec3d& near);
ShapePoint point_on(const Plane& plane, const Vec3d& near);
ShapePoint point_on(const LongFace& face, const Vec3d& near);

/// A box that holds the shape, rounding included.
struct ShapeBox {
  Vec3f low, high;
};
ShapeBox box_around(const Sphere& sphere);
ShapeBox box_around(const Disk& disk);
ShapeBox box_around(const Cylinder& cylinder);
ShapeBox box_around(const LongFace& face);

}  // namespace photonproof
