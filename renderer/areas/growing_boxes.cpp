#include "renderer/areas/growing_boxes.h"

#include <utility>

namespace photonproof::inline renderer_areas {

void GrowingBoxes::add(const ShapeBox& box, std::uint32_t number) {
  Tree grown;
  grown.added.push_back({box, number});
  while (!trees_.empty() && trees_.back().added.size() <= grown.added.size()) {
    const std::vector<Numbered>& last = trees_.back().added;
    grown.added.insert(grown.added.end(), last.begin(), last.end());
    trees_.pop_back();
  }
  std::vector<BoxTree::Part> parts;
  parts.reserve(grown.added.size());
  for (const Numbered& n : grown.added) parts.push_back(part_of_box(n.box));
  grown.boxes = BoxTree(parts, grown.order);
  trees_.push_back(std::move(grown));
}

}  // namespace photonproof::inline renderer_areas
