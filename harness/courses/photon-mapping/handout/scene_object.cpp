#include "scene_object.h"

void SceneObject::set_hit(const Ray& ray, double t, Vec3 normal, Intersection* hit) const {
  hit->t = t;
  hit->position = ray.at(t);
  hit->normal = normal;
  hit->front = dot(ray.direction, normal) < 0;
  hit->material = material_;
}
