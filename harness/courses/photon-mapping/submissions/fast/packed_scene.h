// The scene as arrays of rectangles, balls and grids of heights for rays; no virtual calls, no repeated computations.
#pragma once

#include <vector>

#include "scene_object.h"
#include "vec.h"

struct Ray {
  Vec3 origin, direction;
  Vec3 at(double t) const { return origin + direction * t; }
};

struct Hit {
  double t = 1e30;
  Vec3 position, normal;
  bool front = true;
  const Material* material = nullptr;
  int rectangle = -1;   ///< index of the rectangle, if it is one
  double u = 0, v = 0;  ///< position on it, -1 to 1
};

struct Lamp {
  Vec3 center, a, b, normal;
  double area;
  Vec3 radiance;
};

struct Water {
  Vec3 center, a, b, up;
  int columns = 1, rows = 1;
  double frequency_a = 1, frequency_b = 1;
  unsigned seed = 0;
};

struct Rectangle {
  Vec3 normal, u, v;
  double dn, du, dv;  ///< dot products of these with the centre
  Vec3 center, a, b;
  int material;
};

class PackedScene {
 public:
  void add_rectangle(Vec3 center, Vec3 a, Vec3 b, const Material& material);
  void add_ball(Vec3 center, double radius, const Material& material);
  void add_water(const Water& water, const Material& material);

  bool first_hit(const Ray& ray, Hit* hit) const;
  /// Whether anything is nearer than t.
  bool blocked(const Ray& ray, double t) const;

  const std::vector<Rectangle>& rectangles() const { return rectangles_; }
  const Material& material(int i) const { return materials_[i]; }

 private:
  struct Ball {
    Vec3 center;
    double r2;
    int material;
  };
  struct Grid {
    Vec3 center, to_x, to_y, to_z, normal_x, normal_y, normal_z;
    int columns, rows;
    double low, high;
    std::vector<double> heights;
    std::vector<Vec3> normals;
    int material;
  };
  bool meet(const Grid& grid, const Ray& ray, double most, double* t, Vec3* normal) const;
  std::vector<Rectangle> rectangles_;
  std::vector<Ball> balls_;
  std::vector<Grid> grids_;
  std::vector<Material> materials_;
};
