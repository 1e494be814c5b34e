// An axis-aligned box around points, in double precision.
#pragma once

#include <algorithm>
#include <limits>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_base {

/// Empty until a point is added.
struct Bounds3d {
  Vec3d low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void add(const Vec3d& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool empty() const { return !(low.x <= high.x); }
  bool overlaps(const Bounds3d& b) const {
    return low.x < b.high.x && b.low.x < high.x && low.y < b.high.y && b.low.y < high.y && low.z < b.high.z &&
           b.low.z < high.z;
  }
};

}  // namespace photonproof::inline scenes_base
