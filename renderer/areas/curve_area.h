// The counterpart of disc_area (shape.h) for curves: the area of a shape's tubes within the gather radius whose photons
// pass the surface side's test. Tubes are cut into short cones. A tree over their boxes finds those near a gather.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/areas/box_tree.h"
#include "renderer/shapes/curves.h"

namespace photonproof::inline renderer_areas {

class CurveArea {
 public:
  /// `curves` must not change; it may end before this does.
  explicit CurveArea(const Curves& curves);

  /// The area for a gather at p with the unit outward normal there. On a straight tube of constant radius it is exact
  /// to 1e-3. Tubes that enter each other count whole, and so do the joints of a polyline that its cones leave open.
  double within(const Vec3f& p, const Vec3f& outward, float radius) const;

  std::size_t memory_bytes() const { return pieces_.capacity() * sizeof(Piece) + tree_.memory_bytes(); }

 private:
  /// A cone, or the half of a ball at an end: that has no length, and its axis points out.
  struct Piece {
    Vec3f start, axis;  ///< axis is unit
    float length = 0, radius = 0;
    float slant = 1;  ///< factor on the cylinder's area
  };
  struct Gather;

  static std::vector<Piece> cut(const Curves& curves);
  static double of_cone(const Gather& at, const Piece& piece);
  static double of_end(const Gather& at, const Piece& piece);

  std::vector<Piece> pieces_;  ///< by their places in the tree
  BoxTree tree_;
};

}  // namespace photonproof::inline renderer_areas
