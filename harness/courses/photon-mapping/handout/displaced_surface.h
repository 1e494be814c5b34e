// A surface displaced by noise: the water. It is a grid of cells of two triangles each over a parallelogram.
#pragma once

#include "scene_object.h"

struct Water {
  Vec3 center, a, b;          ///< of the still surface: its centre and half-edges
  Vec3 up;                    ///< the surface's displacement where the noise is 1; at right angles to a and b
  int columns = 1, rows = 1;  ///< cells along a and b
  double frequency_a = 1, frequency_b = 1;  ///< cells of the noise along the half-edges
  unsigned seed = 0;                        ///< of the noise
};

class DisplacedSurface : public SceneObject {
 public:
  DisplacedSurface(Water water, Material material) : SceneObject(material), water_(water) {}
  bool intersect(const Ray& ray, Intersection* hit) const override;

  /// Height at the corner (column, row) of the grid, as a multiple of `up`.
  double height(int column, int row) const;

 private:
  bool intersect_cell(const Ray& local, int column, int row, double* t, Vec3* normal) const;
  Vec3 corner(int column, int row) const;
  Vec3 slope_normal(int column, int row) const;
  Water water_;
};
