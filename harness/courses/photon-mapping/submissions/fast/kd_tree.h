// Photons in a balanced kd-tree that is an array, and sums over the nearest of them without allocation.
#pragma once

#include <vector>

#include "vec.h"

struct Photon {
  float position[3], normal[3], power[3];
  int axis;
};

inline Photon make_photon(Vec3 p, Vec3 n, Vec3 power) {
  return {{float(p.x), float(p.y), float(p.z)},
          {float(n.x), float(n.y), float(n.z)},
          {float(power.x), float(power.y), float(power.z)},
          0};
}

class KdTree {
 public:
  void build(std::vector<Photon> photons);
  /// Irradiance of at most `count` photons within `radius`: their power divided by the area on which they landed.
  Vec3 irradiance(Vec3 position, Vec3 normal, int count, double radius) const;
  const Photon* nearest(Vec3 position, Vec3 normal, double radius) const;

 private:
  std::vector<Photon> photons_;
};
