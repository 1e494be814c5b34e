// A tree over the boxes of a shape's parts. It finds those near a gather.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/shapes/shape.h"

namespace photonproof::inline renderer_areas {

/// Whether the boxes have a common point. An empty box has none.
inline bool boxes_meet(const ShapeBox& a, const ShapeBox& b) {
  const auto along = [&](float Vec3f::*axis) { return a.low.*axis <= b.high.*axis && b.low.*axis <= a.high.*axis; };
  return along(&Vec3f::x) && along(&Vec3f::y) && along(&Vec3f::z);
}

class BoxTree {
 public:
  struct Part {
    ShapeBox box;
    Vec3f middle;  ///< splits are at medians of these
  };

  BoxTree() = default;
  /// `order` becomes the number of the part at each place. Parts near each other have neighbouring places.
  BoxTree(const std::vector<Part>& parts, std::vector<std::uint32_t>& order);

  /// Whether test(place) is true for some part of the leaves whose boxes meet a region; the search ends at the first.
  /// `meets(const ShapeBox&)` says whether a box meets it, and must be true of every box around one that does.
  template <class Meets, class Test>
  bool any_of(const Meets& meets, const Test& test) const {
    std::array<std::uint32_t, 64> waiting;
    std::size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
      const std::uint32_t here = waiting[--count];
      const Node& node = nodes_[here];
      if (!meets(node.box)) continue;
      if (node.right != 0) {
        waiting[count++] = node.right;
        waiting[count++] = here + 1;
        continue;
      }
      for (std::uint32_t place = node.begin; place < node.end; ++place)
        if (test(place)) return true;
    }
    return false;
  }

  /// Calls visit(place) for all parts of the leaves whose boxes meet a region.
  template <class Meets, class Visit>
  void visit(const Meets& meets, const Visit& visit) const {
    any_of(meets, [&](std::uint32_t place) {
      visit(place);
      return false;
    });
  }

  /// The same for the ball about p.
  template <class Visit>
  void visit_near(const Vec3f& p, float radius, const Visit& to_visit) const {
    const auto is_near = [&](const ShapeBox& box) {
      const Vec3f nearest{std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y),
                          std::clamp(p.z, box.low.z, box.high.z)};
      return !(length_squared(nearest - p) > radius * radius);
    };
    visit(is_near, to_visit);
  }

  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  struct Node {
    ShapeBox box;
    std::uint32_t begin = 0, end = 0;  ///< its places
    std::uint32_t right = 0;           ///< the second child; the first follows the node. 0 at a leaf
  };

  void build(const std::vector<Part>& parts, std::vector<std::uint32_t>& order, std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
};

/// A part that is no more than its box. Empty boxes, whose middles are undefined, are split as if at the origin.
BoxTree::Part part_of_box(const ShapeBox& box);

}  // namespace photonproof::inline renderer_areas
