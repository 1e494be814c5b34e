// Tests of boxes against solids and flat shapes, for searches in trees of boxes (box_tree.h). They say no only where a
// plane lies between the two: one across an axis, or along a side (Gottschalk, Lin and Manocha 1996, "OBBTree").
#pragma once

#include <array>
#include <cstddef>

#include "renderer/areas/box_tree.h"
#include "renderer/areas/footprint.h"

namespace photonproof::inline renderer_areas {

class SolidBounds {
 public:
  explicit SolidBounds(const Solid& solid);

  /// The box around all points that it holds, and around its footprints.
  const ShapeBox& box() const { return box_; }
  /// False only where the solid holds no point of the box.
  bool meets(const ShapeBox& box) const;

 private:
  struct Slab {
    Vec3d normal{0.0};
    double half = 0;  ///< its thickness
  };

  ShapeBox box_;
  Vec3d middle_;
  double radius_ = 0;          ///< of a ball
  std::array<Slab, 3> slabs_;  ///< of a parallelepiped
};

class FlatBounds {
 public:
  explicit FlatBounds(const Quad& quad);
  explicit FlatBounds(const renderer_shapes::Plane& plane);

  /// False only where no solid in the box has a footprint on the flat shape.
  bool meets(const ShapeBox& box) const;

 private:
  ShapeBox box_;
  Vec3d normal_, point_;
};

}  // namespace photonproof::inline renderer_areas
