// Photons at the points where they landed, in a kd-tree (Jensen 1996), with a search for the nearest ones.
#pragma once

#include <memory>
#include <vector>

#include "vec.h"

struct Photon {
  Vec3 position;
  Vec3 normal;  ///< of the surface, on the side where it landed
  Vec3 power;
};

class PhotonMap {
 public:
  void store(const Photon& photon);
  int size() const { return size_; }

  /// At most `count` photons within `radius`, from the nearest to the farthest: those that landed on a surface like
  /// the one at this position, with this normal.
  std::vector<Photon> nearest(Vec3 position, Vec3 normal, int count, double radius) const;

  /// Irradiance: the photons' power divided by the area on which they landed.
  Vec3 irradiance(Vec3 position, Vec3 normal, int count, double radius) const;

 private:
  struct Node {
    Photon photon;
    std::shared_ptr<Node> lower, upper;
  };
  void look_up(std::shared_ptr<Node> node, int axis, Vec3 position, Vec3 normal, int count, double radius,
               std::vector<Photon>* found) const;
  std::shared_ptr<Node> root_;
  int size_ = 0;
};
