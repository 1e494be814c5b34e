#include "irradiance_cache.h"

#include "config.h"

static int octant(Vec3 p, Vec3 center) {
  return (p.x > center.x ? 1 : 0) + (p.y > center.y ? 2 : 0) + (p.z > center.z ? 4 : 0);
}

void IrradianceCache::insert(const CacheRecord& record) {
  std::shared_ptr<Node> node = std::make_shared<Node>();
  node->record = record;
  node->record.distance = std::min(std::max(record.distance, CACHE_MIN_SPACING), CACHE_MAX_SPACING);
  ++size_;
  std::shared_ptr<Node>* place = &root_;
  while (*place) place = &(*place)->children[octant(record.position, (*place)->record.position)];
  *place = node;
}

void IrradianceCache::add_up(std::shared_ptr<Node> node, Vec3 position, Vec3 normal, Vec3* sum, double* weights) const {
  if (!node) return;
  const CacheRecord& record = node->record;
  Vec3 way = position - record.position;
  // Ward's estimate of the error: the farther and the more turned, the less it is worth.
  double error = length(way) / record.distance + std::sqrt(std::max(0.0, 1 - dot(normal, record.normal)));
  bool behind = dot(way, normal + record.normal) / 2 < -0.01 * record.distance;
  if (error < CACHE_TOLERANCE && !behind) {
    double weight = 1 / std::max(error, 1e-6) - 1 / CACHE_TOLERANCE;
    *sum += record.irradiance * weight;
    *weights += weight;
  }
  // No record reaches farther than the maximum spacing.
  double reach = CACHE_MAX_SPACING * CACHE_TOLERANCE;
  for (int i = 0; i < 8; ++i) {
    bool wanted = true;
    if (i & 1 ? way.x < -reach : way.x > reach) wanted = false;
    if (i & 2 ? way.y < -reach : way.y > reach) wanted = false;
    if (i & 4 ? way.z < -reach : way.z > reach) wanted = false;
    if (wanted) add_up(node->children[i], position, normal, sum, weights);
  }
}

bool IrradianceCache::interpolate(Vec3 position, Vec3 normal, Vec3* irradiance) const {
  Vec3 sum;
  double weights = 0;
  add_up(root_, position, normal, &sum, &weights);
  if (weights <= 0) return false;
  *irradiance = sum / weights;
  return true;
}
