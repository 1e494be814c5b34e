// A flat square or parallelogram: a centre and two half-edges. Its front is where cross(a, b) points.
#pragma once

#include "scene_object.h"

class Square : public SceneObject {
 public:
  Square(Vec3 center, Vec3 a, Vec3 b, Material material) : SceneObject(material), center_(center), a_(a), b_(b) {}
  bool intersect(const Ray& ray, Intersection* hit) const override;

  Vec3 center() const { return center_; }
  Vec3 a() const { return a_; }
  Vec3 b() const { return b_; }

 private:
  Vec3 center_, a_, b_;
};
