#pragma once

#include "packed_scene.h"
#include "scene_object.h"

class Cube : public SceneObject {
 public:
  Cube(Vec3 center, Vec3 a, Vec3 b, Vec3 c, Material material) : SceneObject(material), center_(center), a_{a, b, c} {}
  void pack(PackedScene* scene) const override {
    for (int i = 0; i < 3; ++i)
      for (double side : {-1.0, 1.0}) {
        Vec3 out = a_[i] * side, u = a_[(i + 1) % 3], v = a_[(i + 2) % 3];
        scene->add_rectangle(center_ + out, dot(cross(u, v), out) < 0 ? -u : u, v, material());
      }
  }

 private:
  Vec3 center_, a_[3];
};
