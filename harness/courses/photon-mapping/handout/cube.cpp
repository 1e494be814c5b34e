#include "cube.h"

Cube::Cube(Vec3 center, Vec3 a, Vec3 b, Vec3 c, Material material) : SceneObject(material) {
  auto add = [&](Vec3 out, Vec3 u, Vec3 v) {
    if (dot(cross(u, v), out) < 0) u = -u;  // its front looks outward
    sides_.push_back(std::make_shared<Square>(center + out, u, v, material));
  };
  for (double side : {-1.0, 1.0}) {
    add(a * side, b, c);
    add(b * side, c, a);
    add(c * side, a, b);
  }
}

bool Cube::intersect(const Ray& ray, Intersection* hit) const {
  bool any = false;
  for (std::shared_ptr<Square> side : sides_) {
    Intersection one;
    if (side->intersect(ray, &one) && (!any || one.t < hit->t)) {
      *hit = one;
      any = true;
    }
  }
  return any;
}
