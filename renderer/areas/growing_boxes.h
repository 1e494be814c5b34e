// Boxes that are searched while others are added. They are in trees, each larger than the next: a box enters a new tree
// only as often as the number of boxes doubles. Source: Bentley and Saxe 1980, "Decomposable Searching Problems I".
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/areas/box_tree.h"

namespace photonproof::inline renderer_areas {

class GrowingBoxes {
 public:
  void add(const ShapeBox& box, std::uint32_t number);

  /// Whether test(number) is true for some box that has a point in common with `box`; the search ends at the first.
  template <class Test>
  bool any_of(const ShapeBox& box, const Test& test) const {
    const auto meets = [&](const ShapeBox& other) { return boxes_meet(box, other); };
    return std::ranges::any_of(trees_, [&](const Tree& tree) {
      return tree.boxes.any_of(meets, [&](std::uint32_t place) {
        const Numbered& found = tree.added[tree.order[place]];
        return meets(found.box) && test(found.number);
      });
    });
  }

 private:
  struct Numbered {
    ShapeBox box;
    std::uint32_t number;
  };
  struct Tree {
    std::vector<Numbered> added;
    std::vector<std::uint32_t> order;  ///< the index in `added` of each place
    BoxTree boxes;
  };
  std::vector<Tree> trees_;
};

}  // namespace photonproof::inline renderer_areas
