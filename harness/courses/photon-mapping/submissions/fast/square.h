#pragma once

#include "packed_scene.h"
#include "scene_object.h"

class Square : public SceneObject {
 public:
  Square(Vec3 center, Vec3 a, Vec3 b, Material material) : SceneObject(material), center_(center), a_(a), b_(b) {}
  void pack(PackedScene* scene) const override { scene->add_rectangle(center_, a_, b_, material()); }
  Lamp lamp() const {
    Vec3 n = cross(a_, b_);
    return {center_, a_, b_, normalized(n), 4 * length(n), material().radiance};
  }

 private:
  Vec3 center_, a_, b_;
};
