// A tree over the boxes of a shape's parts. It finds those near a gather.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/shapes/shape.h"

namespace photonproof::inline renderer_areas {

class BoxTree {
 public:
  struct Part {
    ShapeBox box;
    Vec3f middle;  ///< splits are at medians of these
  };

  BoxTree() = default;
  /// `order` becomes the number of the part at each place. Parts near each other have neighbouring places.
  BoxTree(const std::vector<Part>& parts, std::vector<std::uint32_t>& order);

  /// Calls visit(place) for all parts of the leaves whose boxes reach within `radius` of p.
  template <class Visit>
  void visit_near(const Vec3f& p, float radius, const Visit& visit) const {
    std::array<std::uint32_t, 64> waiting;
    std::size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
      const std::uint32_t here = waiting[--count];
      const Node& node = nodes_[here];
      const Vec3f nearest{std::clamp(p.x, node.box.low.x, node.box.high.x),
                          std::clamp(p.y, node.box.low.y, node.box.high.y),
                          std::clamp(p.z, node.box.low.z, node.box.high.z)};
      if (length_squared(nearest - p) > radius * radius) continue;
      if (node.right != 0) {
        waiting[count++] = node.right;
        waiting[count++] = here + 1;
        continue;
      }
      for (std::uint32_t place = node.begin; place < node.end; ++place) visit(place);
    }
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

}  // namespace photonproof::inline renderer_areas
