// Objects as in scene files. They are packed before rendering: packed_scene.h.
#pragma once

#include "vec.h"

enum class MaterialKind { diffuse, mirror, glass, light };

struct Material {
  MaterialKind kind = MaterialKind::diffuse;
  Vec3 colour{0.7, 0.7, 0.7};
  double ior = 1;
  Vec3 radiance;
};

class PackedScene;

class SceneObject {
 public:
  explicit SceneObject(Material material) : material_(material) {}
  virtual ~SceneObject() {}
  virtual void pack(PackedScene* scene) const = 0;
  const Material& material() const { return material_; }

 private:
  Material material_;
};
