#include "cache.h"

#include <mutex>

#include "config.h"

static const double root_half = 4096;  // records outside stay at the root, where they are found too

static Vec3 child_center(Vec3 center, double half, int i) {
  double q = half / 2;
  return center + Vec3{i & 1 ? q : -q, i & 2 ? q : -q, i & 4 ? q : -q};
}

static bool inside(Vec3 p, Vec3 center, double half) {
  return std::fabs(p.x - center.x) <= half && std::fabs(p.y - center.y) <= half && std::fabs(p.z - center.z) <= half;
}

void IrradianceCache::insert(Node* node, Vec3 center, double half, const CacheRecord& record, double reach) {
  if (half < 2 * reach) {
    node->records.push_back(record);
    return;
  }
  for (int i = 0; i < 8; ++i) {
    Vec3 c = child_center(center, half, i);
    if (!inside(record.position, c, half / 2 + reach)) continue;
    if (!node->children[i]) node->children[i] = std::make_unique<Node>();
    insert(node->children[i].get(), c, half / 2, record, reach);
  }
}

void IrradianceCache::insert(CacheRecord record) {
  record.distance = std::min(std::max(record.distance, CACHE_MIN_SPACING), CACHE_MAX_SPACING);
  std::unique_lock<std::shared_mutex> lock(mutex_);
  if (inside(record.position, {}, root_half / 2)) {
    insert(&root_, {}, root_half, record, record.distance * CACHE_TOLERANCE);
  } else {
    root_.records.push_back(record);
  }
}

bool IrradianceCache::interpolate(Vec3 position, Vec3 normal, Vec3* irradiance) const {
  std::shared_lock<std::shared_mutex> lock(mutex_);
  Vec3 sum, center;
  double weights = 0, half = root_half;
  for (const Node* node = &root_; node;) {
    for (const CacheRecord& record : node->records) {
      Vec3 way = position - record.position;
      double d2 = dot(way, way), reach = CACHE_TOLERANCE * record.distance;
      if (d2 >= reach * reach) continue;
      double error = std::sqrt(d2) / record.distance + std::sqrt(std::max(0.0, 1 - dot(normal, record.normal)));
      if (error >= CACHE_TOLERANCE || dot(way, normal + record.normal) / 2 < -0.01 * record.distance) continue;
      double weight = 1 / std::max(error, 1e-6) - 1 / CACHE_TOLERANCE;
      sum += record.irradiance * weight;
      weights += weight;
    }
    int i = (position.x > center.x) + 2 * (position.y > center.y) + 4 * (position.z > center.z);
    center = child_center(center, half, i);
    half /= 2;
    node = node->children[i].get();
  }
  if (weights <= 0) return false;
  *irradiance = sum / weights;
  return true;
}
