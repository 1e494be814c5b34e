#pragma once

#include "packed_scene.h"
#include "scene_object.h"

class Sphere : public SceneObject {
 public:
  Sphere(Vec3 center, double radius, Material material) : SceneObject(material), center_(center), radius_(radius) {}
  void pack(PackedScene* scene) const override { scene->add_ball(center_, radius_, material()); }

 private:
  Vec3 center_;
  double radius_;
};
