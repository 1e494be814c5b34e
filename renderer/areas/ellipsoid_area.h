// The counterpart of disc_area (shape.h) for clouds of ellipsoids: the area of those within the gather radius whose
// photons pass the surface side's test. A tree over their boxes finds the ones near a gather.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/areas/box_tree.h"
#include "renderer/shapes/ellipsoids.h"

namespace photonproof::inline renderer_areas {

class EllipsoidArea {
 public:
  /// `ellipsoids` must outlive this.
  explicit EllipsoidArea(const Ellipsoids& ellipsoids);

  /// The area for a gather at p with the unit outward normal there. It is exact to 1e-3 on the gather's own ellipsoid
  /// while the radius is below a third of the least radius of curvature, and to a few percent else. Ellipsoids that
  /// enter each other count whole.
  double within(const Vec3f& p, const Vec3f& outward, float radius) const;

 private:
  struct Gather;

  static double part_of(const Gather& at, const Ellipsoids::Place& place);

  const Ellipsoids& ellipsoids_;
  std::vector<std::uint32_t> order_;  ///< numbers of ellipsoids by their places in the tree
  BoxTree tree_;
};

}  // namespace photonproof::inline renderer_areas
