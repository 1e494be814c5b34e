#include "renderer/areas/covered_part.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "renderer/areas/solid_bounds.h"

namespace photonproof::inline renderer_areas {
namespace {

BoxTree::Part part_of(const Footprint& footprint) {
  const ShapeBox box = footprint.box();
  return {box, box.low * 0.5f + box.high * 0.5f};
}

/// Footprints found by place while others are added. They are in trees, each larger than all after it together: a
/// footprint enters a new tree at most as often as the number of footprints doubles (Bentley and Saxe 1980).
class GrowingTrees {
 public:
  void add(const Footprint& footprint) {
    Tree added;
    added.footprints.push_back(&footprint);
    while (!trees_.empty() && trees_.back().footprints.size() <= added.footprints.size()) {
      const std::vector<const Footprint*>& last = trees_.back().footprints;
      added.footprints.insert(added.footprints.end(), last.begin(), last.end());
      trees_.pop_back();
    }
    std::vector<BoxTree::Part> parts;
    for (const Footprint* f : added.footprints) parts.push_back(part_of(*f));
    added.boxes = BoxTree(parts, added.order);
    trees_.push_back(std::move(added));
  }

  bool any_overlaps(const Footprint& footprint) const {
    const ShapeBox box = footprint.box();
    return std::ranges::any_of(trees_, [&](const Tree& tree) {
      return tree.boxes.any_of(
          [&](const ShapeBox& other) { return boxes_meet(box, other); },
          [&](std::uint32_t place) { return footprint.overlaps(*tree.footprints[tree.order[place]]); });
    });
  }

 private:
  struct Tree {
    std::vector<const Footprint*> footprints;
    std::vector<std::uint32_t> order;
    BoxTree boxes;
  };
  std::vector<Tree> trees_;
};

std::vector<Footprint> largest_apart(std::vector<Footprint> found) {
  std::ranges::stable_sort(found, std::ranges::greater{}, [](const Footprint& f) { return f.area(); });
  GrowingTrees apart;
  std::vector<const Footprint*> kept;
  for (const Footprint& f : found) {
    if (apart.any_overlaps(f)) continue;
    apart.add(f);
    kept.push_back(&f);
  }
  std::vector<Footprint> footprints;
  footprints.reserve(kept.size());
  for (const Footprint* f : kept) footprints.push_back(*f);
  return footprints;
}

}  // namespace

CoveredPart::CoveredPart(std::vector<Footprint> found) : footprints_(largest_apart(std::move(found))) {
  std::vector<BoxTree::Part> parts;
  parts.reserve(footprints_.size());
  for (const Footprint& f : footprints_) parts.push_back(part_of(f));
  tree_ = BoxTree(parts, number_);
}

double CoveredPart::left_of(double area, const Vec3d& p, double radius) const {
  // In double precision: footprints that are left out must be those whose area in the disc is exactly 0.
  const auto is_near = [&](const ShapeBox& box) {
    const Vec3d low(box.low), high(box.high);
    const Vec3d nearest{std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y), std::clamp(p.z, low.z, high.z)};
    return length_squared(nearest - p) <= radius * radius;
  };
  std::vector<std::uint32_t> near;
  tree_.visit(is_near, [&](std::uint32_t place) { near.push_back(number_[place]); });
  std::ranges::sort(near);  // the same sum in the same order, wherever the tree has them
  double left = area;
  for (const std::uint32_t i : near) left -= footprints_[i].in_disc(p, radius);
  return left;
}

}  // namespace photonproof::inline renderer_areas
