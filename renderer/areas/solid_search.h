// Searches among many solids in n log n: which of them hold a box, and which may have a footprint on a flat shape.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/areas/box_tree.h"
#include "renderer/areas/solid_bounds.h"

namespace photonproof::inline renderer_areas {

/// Whether the solid contains a corner or the middle of the box, or the box contains the solid's middle.
bool holds_part(const Solid& solid, const ShapeBox& box);

/// Boxes, some of which may lie in solids.
class HeldBoxes {
 public:
  explicit HeldBoxes(const std::vector<ShapeBox>& boxes);

  /// Whether `holds_part` is true of one of the boxes.
  bool any_in(const Solid& solid) const;
  /// Whether test(box) is true of one of the few boxes near the solid.
  template <class Test>
  bool any_near(const SolidBounds& solid, const Test& test) const {
    return tree_.any_of([&](const ShapeBox& box) { return solid.meets(box); },
                        [&](std::uint32_t place) { return test(boxes_[place]); });
  }

 private:
  std::vector<ShapeBox> boxes_;  ///< by place in the tree
  BoxTree tree_;
};

class SolidTree {
 public:
  explicit SolidTree(const std::vector<Solid>& solids);

  /// Numbers of the solids that may have a footprint on the flat shape, in ascending order.
  std::vector<std::uint32_t> near_flat(const FlatBounds& flat) const;

 private:
  std::vector<ShapeBox> boxes_;        ///< by place in the tree
  std::vector<std::uint32_t> number_;  ///< of the solid at each place
  BoxTree tree_;
};

}  // namespace photonproof::inline renderer_areas
