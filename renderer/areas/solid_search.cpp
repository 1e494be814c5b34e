#include "renderer/areas/solid_search.h"

#include <algorithm>

namespace photonproof::inline renderer_areas {
namespace {

std::vector<BoxTree::Part> parts_of(const std::vector<ShapeBox>& boxes) {
  std::vector<BoxTree::Part> parts;
  parts.reserve(boxes.size());
  for (const ShapeBox& box : boxes) parts.push_back(part_of_box(box));
  return parts;
}

}  // namespace

bool holds_part(const Solid& solid, const ShapeBox& box) {
  const Vec3d low(box.low), high(box.high), m = solid.middle;
  const bool around = m.x > low.x && m.x < high.x && m.y > low.y && m.y < high.y && m.z > low.z && m.z < high.z;
  if (around || solid.holds((low + high) / 2)) return true;
  for (int i = 0; i < 8; ++i)
    if (solid.holds({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z})) return true;
  return false;
}

HeldBoxes::HeldBoxes(const std::vector<ShapeBox>& boxes) {
  std::vector<std::uint32_t> order;
  tree_ = BoxTree(parts_of(boxes), order);
  boxes_.reserve(boxes.size());
  for (const std::uint32_t i : order) boxes_.push_back(boxes[i]);
}

bool HeldBoxes::any_in(const Solid& solid) const {
  const SolidBounds bounds(solid);
  return any_near(bounds, [&](const ShapeBox& box) { return bounds.meets(box) && holds_part(solid, box); });
}

SolidTree::SolidTree(const std::vector<Solid>& solids) {
  std::vector<ShapeBox> boxes;
  boxes.reserve(solids.size());
  for (const Solid& solid : solids) boxes.push_back(SolidBounds(solid).box());
  tree_ = BoxTree(parts_of(boxes), number_);
  boxes_.reserve(boxes.size());
  for (const std::uint32_t i : number_) boxes_.push_back(boxes[i]);
}

std::vector<std::uint32_t> SolidTree::near_flat(const FlatBounds& flat) const {
  std::vector<std::uint32_t> found;
  tree_.visit([&](const ShapeBox& box) { return flat.meets(box); },
              [&](std::uint32_t place) {
                if (flat.meets(boxes_[place])) found.push_back(number_[place]);
              });
  std::ranges::sort(found);
  return found;
}

}  // namespace photonproof::inline renderer_areas
