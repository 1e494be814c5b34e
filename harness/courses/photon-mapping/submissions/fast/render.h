// Photon maps, and the light found by them, by shadow rays and by final gathers.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "cache.h"
#include "kd_tree.h"
#include "packed_scene.h"
#include "random.h"

struct Parts;

class Renderer {
 public:
  Renderer(const PackedScene& scene, const std::vector<Lamp>& lamps, bool has_water, const Parts& parts);
  /// The radiance that arrives along a ray.
  Vec3 trace(const Ray& ray, int depth, Random& random);
  const KdTree& global_map() const { return global_map_; }
  const KdTree& caustic_map() const { return caustic_map_; }

 private:
  // Irradiance by the global map on a lattice of a diffuse rectangle, computed on first use. A second thread computes
  // the same value.
  struct LightMap {
    int columns = 0, rows = 0;
    std::unique_ptr<std::atomic<bool>[]> known;
    std::unique_ptr<Vec3[]> values;
  };
  std::vector<Photon> trace_photons(bool caustics, int count) const;
  void trace_photon(const Lamp& lamp, Vec3 power, bool caustics, Random& random, std::vector<Photon>* photons) const;
  bool scatter(const Hit& hit, Ray* ray, Vec3* power, Random& random) const;
  Vec3 direct(const Hit& hit, Random& random) const;
  Vec3 global(const Hit& hit, Random& random);
  Vec3 gathered_radiance(Ray ray, double* distance, Random& random);
  Vec3 global_irradiance(const Hit& hit);
  Vec3 shade(const Hit& hit, Random& random);

  const PackedScene& scene_;
  const std::vector<Lamp>& lamps_;
  const Parts& parts_;
  double caustic_radius_;
  KdTree global_map_, caustic_map_;
  std::vector<LightMap> light_maps_;
  IrradianceCache cache_;
};
