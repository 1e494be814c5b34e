// The parts of a scene. Each kind of object has its own file and its own intersection with a ray.
#pragma once

#include "vec.h"

enum class MaterialKind { diffuse, mirror, glass, light };

struct Material {
  MaterialKind kind = MaterialKind::diffuse;
  Vec3 colour{0.7, 0.7, 0.7};  ///< share of light that is reflected; of glass, that passes each interface
  double ior = 1;              ///< of glass: index of refraction behind the surface
  Vec3 radiance;               ///< of a light: what its front emits
};

struct Ray {
  Vec3 origin, direction;  ///< of length 1
  Vec3 at(double t) const { return origin + direction * t; }
};

struct Intersection {
  double t = 1e30;  ///< distance along the ray
  Vec3 position;
  Vec3 normal;        ///< of length 1, away from the object
  bool front = true;  ///< the ray came from the normal's side
  Material material;
};

class SceneObject {
 public:
  explicit SceneObject(Material material) : material_(material) {}
  virtual ~SceneObject() {}

  /// The first hit farther than EPSILON, in *hit; false if there is none.
  virtual bool intersect(const Ray& ray, Intersection* hit) const = 0;

  Material material() const { return material_; }

 protected:
  /// Fills *hit for a surface of this outward normal.
  void set_hit(const Ray& ray, double t, Vec3 normal, Intersection* hit) const;

 private:
  Material material_;
};
