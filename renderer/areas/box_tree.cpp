#include "renderer/areas/box_tree.h"

#include <numeric>

namespace photonproof::inline renderer_areas {
namespace {

constexpr std::uint32_t most_in_leaf = 4;

float coordinate(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

BoxTree::Part part_of_box(const ShapeBox& box) {
  const Vec3f middle = box.low * 0.5f + box.high * 0.5f;
  return {box, is_finite(middle) ? middle : Vec3f(0.0f)};
}

BoxTree::BoxTree(const std::vector<Part>& parts, std::vector<std::uint32_t>& order) {
  order.resize(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  if (!parts.empty()) build(parts, order, 0, static_cast<std::uint32_t>(parts.size()));
}

void BoxTree::build(const std::vector<Part>& parts, std::vector<std::uint32_t>& order, std::uint32_t begin,
                    std::uint32_t end) {
  const std::size_t here = nodes_.size();
  ShapeBox box, middles;
  for (std::uint32_t place = begin; place < end; ++place) {
    box.add(parts[order[place]].box);
    middles.add(parts[order[place]].middle);
  }
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= most_in_leaf) return;
  const Vec3f extent = middles.high - middles.low;
  const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::uint32_t place) { return order.begin() + static_cast<std::ptrdiff_t>(place); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return coordinate(parts[a].middle, axis) < coordinate(parts[b].middle, axis);
  });
  build(parts, order, begin, middle);
  nodes_[here].right = static_cast<std::uint32_t>(nodes_.size());
  build(parts, order, middle, end);
}

}  // namespace photonproof::inline renderer_areas
