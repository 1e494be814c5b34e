// The part of one side of a flat shape that solids cover. Footprints on it are found by place, so that a gather costs
// as much beside a thousand solids as beside a few.
#pragma once

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
  /// Numbers of the footprints that the disc may meet, in ascending order: sums over them have one order and one value.
  std::vector<std::uint32_t> near(const Vec3d& p, double radius) const;

 private:
  std::vector<Footprint> footprints_;
  std::vector<std::uint32_t> number_;  ///< of the footprint at each place in the tree
  BoxTree tree_;
};

}  // namespace photonproof::inline renderer_areas
