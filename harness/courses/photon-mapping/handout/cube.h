// A cube or any other box: six squares.
#pragma once

#include <memory>
#include <vector>

#include "square.h"

class Cube : public SceneObject {
 public:
  /// A centre and three half-edges.
  Cube(Vec3 center, Vec3 a, Vec3 b, Vec3 c, Material material);
  bool intersect(const Ray& ray, Intersection* hit) const override;

 private:
  std::vector<std::shared_ptr<Square>> sides_;
};
