// The primitives of a small scene in the form of its kernel (brute_force_intersector.h).
#pragma once

#include <vector>

#include "renderer/rays/ray_scene.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_rays {

class BruteForceTables {
 public:
  /// Parallelograms, triangles and spheres up to this radius; Embree holds all other shapes.
  static bool can_hold(const Geometry& geometry, double largest_ball);

  /// Tables of the surfaces; can_hold must be true for all.
  explicit BruteForceTables(const std::vector<Surface>& surfaces);
  /// Valid as long as this.
  BruteForceView view() const;
  /// Number of the surface's first primitive.
  std::uint32_t first_primitive(std::uint32_t surface) const { return first_primitive_[surface]; }
  /// Triangle index of each primitive in its mesh; 0 for other primitives.
  const std::uint32_t* triangles() const { return triangle_of_primitive_.data(); }

 private:
  std::vector<Plate> plates_;
  std::vector<Ball> balls_;
  std::vector<std::uint32_t> surface_of_primitive_, triangle_of_primitive_;
  std::vector<std::uint32_t> first_primitive_;
  std::uint32_t parallelograms_ = 0;
};

}  // namespace photonproof::inline renderer_rays
