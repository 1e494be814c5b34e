// The primitives of a small scene in the form its kernel wants (brute_force.h).
#pragma once

#include <vector>

#include "renderer/rays/ray_scene.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_rays {

class BruteForceTables {
 public:
  /// Parallelograms, triangles and spheres up to this radius; whatever else there is is Embree's.
  static bool can_hold(const Geometry& geometry, double largest_ball);

  /// Of surfaces that it can hold.
  explicit BruteForceTables(const std::vector<Surface>& surfaces);
  /// Valid as long as this.
  BruteForceView view() const;
  /// Number of the surface's first primitive.
  std::uint32_t first_primitive(std::uint32_t surface) const { return first_primitive_[surface]; }
  /// Which triangle of its mesh each primitive is; 0 of what is none.
  const std::uint32_t* triangles() const { return triangle_of_primitive_.data(); }

 private:
  std::vector<Plate> plates_;
  std::vector<Ball> balls_;
  std::vector<std::uint32_t> surface_of_primitive_, triangle_of_primitive_;
  std::vector<std::uint32_t> first_primitive_;
  std::uint32_t parallelograms_ = 0;
};

}  // namespace photonproof::inline renderer_rays
