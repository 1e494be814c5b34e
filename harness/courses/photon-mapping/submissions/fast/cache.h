// The irradiance cache shared by threads: an octree with each record in the nodes of its size that it reaches.
#pragma once

#include <memory>
#include <shared_mutex>
#include <vector>

#include "vec.h"

struct CacheRecord {
  Vec3 position, normal, irradiance;
  double distance = 0;
};

class IrradianceCache {
 public:
  bool interpolate(Vec3 position, Vec3 normal, Vec3* irradiance) const;
  void insert(CacheRecord record);

 private:
  struct Node {
    std::vector<CacheRecord> records;
    std::unique_ptr<Node> children[8];
  };
  void insert(Node* node, Vec3 center, double half, const CacheRecord& record, double reach);
  Node root_;
  mutable std::shared_mutex mutex_;
};
