#pragma once

#include "scene_object.h"

class Sphere : public SceneObject {
 public:
  Sphere(Vec3 center, double radius, Material material) : SceneObject(material), center_(center), radius_(radius) {}
  bool intersect(const Ray& ray, Intersection* hit) const override;

 private:
  Vec3 center_;
  double radius_;
};
