#include "renderer/areas/covered_part.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "renderer/areas/growing_boxes.h"

namespace photonproof::inline renderer_areas {
namespace {

std::vector<Footprint> largest_apart(std::vector<Footprint> found) {
  std::ranges::stable_sort(found, std::ranges::greater{}, [](const Footprint& f) { return f.area(); });
  GrowingBoxes taken;
  std::vector<Footprint> apart;
  for (Footprint& f : found) {
    const ShapeBox box = f.box();
    if (taken.any_of(box, [&](std::uint32_t larger) { return f.overlaps(apart[larger]); })) continue;
    taken.add(box, static_cast<std::uint32_t>(apart.size()));
    apart.push_back(std::move(f));
  }
  return apart;
}

}  // namespace

CoveredPart::CoveredPart(std::vector<Footprint> found) : footprints_(largest_apart(std::move(found))) {
  std::vector<BoxTree::Part> parts;
  parts.reserve(footprints_.size());
  for (const Footprint& f : footprints_) parts.push_back(part_of_box(f.box()));
  tree_ = BoxTree(parts, number_);
}

std::size_t CoveredPart::near(const Vec3d& p, double radius, Near& found) const {
  const auto is_near = [&](const ShapeBox& box) {
    const Vec3d low(box.low), high(box.high);
    const Vec3d nearest{std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y), std::clamp(p.z, low.z, high.z)};
    return length_squared(nearest - p) <= radius * radius;
  };
  std::size_t count = 0;
  tree_.any_of(is_near, [&](std::uint32_t place) {
    if (count < most_near) found[count] = number_[place];
    return ++count > most_near;
  });
  if (count <= most_near) std::sort(found.begin(), found.begin() + count);
  return count;
}

double CoveredPart::left_of(double area, const Vec3d& p, double radius) const {
  constexpr std::size_t few = 8;  // cheaper than a search
  Near found;
  const std::size_t count = footprints_.size() <= few ? most_near + 1 : near(p, radius, found);
  if (count > most_near)
    for (const Footprint& f : footprints_) area -= f.in_disc(p, radius);
  else
    for (std::size_t i = 0; i < count; ++i) area -= footprints_[found[i]].in_disc(p, radius);
  return area;
}

}  // namespace photonproof::inline renderer_areas
