#include "square.h"

#include "config.h"

bool Square::intersect(const Ray& ray, Intersection* hit) const {
  Vec3 normal = normalized(cross(a_, b_));
  double slope = dot(ray.direction, normal);
  if (slope == 0) return false;
  double t = dot(center_ - ray.origin, normal) / slope;
  if (t < EPSILON) return false;
  // Where on the plane, as multiples of the half-edges.
  Vec3 p = ray.at(t) - center_;
  Vec3 n = cross(a_, b_);
  double u = dot(cross(p, b_), n) / dot(n, n), v = dot(cross(a_, p), n) / dot(n, n);
  if (std::fabs(u) > 1 || std::fabs(v) > 1) return false;
  set_hit(ray, t, normal, hit);
  return true;
}
