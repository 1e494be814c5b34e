// A square light that emits photons. Its light on a point of a surface has three parts:
//   direct   straight from the light: shadow rays to points on it
//   caustic  last by mirrors and glass: the caustic photon map
//   global   last by another diffuse surface: rays to all sides (final gather), which end in the
//            global photon map; the irradiance cache interpolates between few gathers
#pragma once

#include <memory>

#include "irradiance_cache.h"
#include "photon_map.h"
#include "square.h"

class Raytracer;

class LightSource {
 public:
  /// The square's material is a light. `scene` has the objects; it outlives the light.
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
