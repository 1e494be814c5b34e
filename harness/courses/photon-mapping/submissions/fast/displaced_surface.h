#pragma once

#include "packed_scene.h"
#include "scene_object.h"

class DisplacedSurface : public SceneObject {
 public:
  DisplacedSurface(Water water, Material material) : SceneObject(material), water_(water) {}
  void pack(PackedScene* scene) const override { scene->add_water(water_, material()); }

 private:
  Water water_;
};
