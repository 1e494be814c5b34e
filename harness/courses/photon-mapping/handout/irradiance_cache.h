// Indirect light at a few points, with interpolation between them (Ward, Rubinstein and Clear 1988).
#pragma once

#include <memory>

#include "vec.h"

struct CacheRecord {
  Vec3 position, normal;
  Vec3 irradiance;
  double distance = 0;  ///< harmonic mean of the distances to the surfaces seen from there
};

class IrradianceCache {
 public:
  /// False if no record is near enough: then the caller must gather and insert a record.
  bool interpolate(Vec3 position, Vec3 normal, Vec3* irradiance) const;
  void insert(const CacheRecord& record);
  int size() const { return size_; }

 private:
  struct Node {
    CacheRecord record;
    std::shared_ptr<Node> children[8];  ///< further records, by the octant in which they are as seen from this one
  };
  void add_up(std::shared_ptr<Node> node, Vec3 position, Vec3 normal, Vec3* sum, double* weights) const;
  std::shared_ptr<Node> root_;
  int size_ = 0;
};
