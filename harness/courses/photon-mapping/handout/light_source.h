// A square lamp that sends out photons. Its light on a point of a surface has three parts:
//   direct   straight from the lamp: shadow rays to places on it
//   caustic  by mirrors and glass, and then here: the caustic photon map
//   global   by another diffuse surface, in whatever way: rays to all sides (final gather), where they end the global
//            photon map; at few points, the irradiance cache interpolates between them
#pragma once

#include <memory>

#include "irradiance_cache.h"
#include "photon_map.h"
#include "square.h"

class Raytracer;

class LightSource {
 public:
  /// Of a square whose material is a light. `scene` has the objects; it outlives the lamp.
  LightSource(std::shared_ptr<Square> square, const Raytracer* scene) : square_(square), scene_(scene) {}

  void build_global_map(int photons);
  void build_caustic_map(int photons);

  /// Irradiance, power by area, at a hit of a diffuse surface.
  Vec3 direct(const Intersection& hit) const;
  Vec3 caustic(const Intersection& hit) const;
  Vec3 global(const Intersection& hit);

  const PhotonMap& global_map() const { return global_map_; }
  const PhotonMap& caustic_map() const { return caustic_map_; }
  int gathers() const { return cache_.size(); }

 private:
  Vec3 gather(const Intersection& hit, double* distance) const;
  Vec3 gathered_radiance(Ray ray, double* distance) const;
  Ray emit() const;
  Vec3 flux() const;

  std::shared_ptr<Square> square_;
  const Raytracer* scene_;
  PhotonMap global_map_, caustic_map_;
  IrradianceCache cache_;
};
