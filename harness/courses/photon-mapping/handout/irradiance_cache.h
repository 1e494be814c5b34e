// Indirect light at few points, between which is interpolated (Ward, Rubinstein and Clear 1988).
#pragma once

#include <memory>

#include "vec.h"

struct CacheRecord {
  Vec3 position, normal;
  Vec3 irradiance;
  double distance = 0;  ///< harmonic mean of the distances to what is seen from there
};

class IrradianceCache {
 public:
  /// False where no record is near enough: then somebody has to gather, and insert.
  bool interpolate(Vec3 position, Vec3 normal, Vec3* irradiance) const;
  void insert(const CacheRecord& record);
  int size() const { return size_; }

 private:
  struct Node {
    CacheRecord record;
    std::shared_ptr<Node> children[8];  ///< records beyond, by the octant they lie in as seen from this one
  };
  void add_up(std::shared_ptr<Node> node, Vec3 position, Vec3 normal, Vec3* sum, double* weights) const;
  std::shared_ptr<Node> root_;
  int size_ = 0;
};
