// The part of one side of a flat shape that solids cover. Footprints on it are found by place, so that a gather costs
// as much beside a thousand solids as beside a few.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/areas/box_tree.h"
#include "renderer/areas/footprint.h"

namespace photonproof::inline renderer_areas {

class CoveredPart {
 public:
  /// Area that two footprints cover must count once: of overlapping footprints only the largest stays.
  explicit CoveredPart(std::vector<Footprint> found);

  /// `area` less what footprints cover of the disc about p in the shape's plane; below 0 where rounding leaves that.
  double left_of(double area, const Vec3d& p, double radius) const;
  /// The footprints, from the largest on.
  const std::vector<Footprint>& footprints() const { return footprints_; }
  /// Numbers of footprints near a gather, without memory from the heap.
  static constexpr std::size_t most_near = 64;
  using Near = std::array<std::uint32_t, most_near>;
  /// Count of the footprints that the disc may meet. Up to `most_near`, their numbers are in `found`, ascending, so
  /// that sums over them have one order and one value.
  std::size_t near(const Vec3d& p, double radius, Near& found) const;

 private:
  std::vector<Footprint> footprints_;
  std::vector<std::uint32_t> number_;  ///< of the footprint at each place in the tree
  BoxTree tree_;
};

}  // namespace photonproof::inline renderer_areas
