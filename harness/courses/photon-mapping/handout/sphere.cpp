#include "sphere.h"

#include "config.h"

bool Sphere::intersect(const Ray& ray, Intersection* hit) const {
  // t^2 + 2 half t + c = 0
  Vec3 from = ray.origin - center_;
  double half = dot(from, ray.direction), c = dot(from, from) - std::pow(radius_, 2);
  double inside = std::pow(half, 2) - c;
  if (inside < 0) return false;
  double t = -half - std::sqrt(inside);
  if (t < EPSILON) t = -half + std::sqrt(inside);
  if (t < EPSILON) return false;
  set_hit(ray, t, normalized(ray.at(t) - center_), hit);
  return true;
}
