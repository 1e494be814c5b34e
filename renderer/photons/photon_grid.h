// The cell of a uniform grid that a point lies in, and the cells that a ball touches, in floats and without a miss.
//
// A cell is found by x -> min(trunc((x - low) / width), last). Every step of that is monotone in x under rounding, so a
// photon between two points along an axis is in a cell between theirs. It remains to show that a photon at
// fl(fl(x - p)^2) <= fl(r^2) lies between p - reach and p + reach as reach() computes them. Rounded squares of two
// neighbouring floats differ unless they underflow. So |fl(x - p)| is at most r, or it is below 2^-62, where squares
// may be flushed to 0. Then |x - p| is at most r (1 + 2^-23) or 2^-61, and the rounding of p + reach is below 2^-24
// (|p| + reach). Points outside the grid belong to its border cells.
#pragma once

#include <cstdint>
#include <limits>

#include "renderer/lanes/always_inline.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_photons {

struct PhotonGrid {
  struct Cell {
    std::int32_t x, y, z;
  };
  struct Range {
    Cell low, high;  ///< both included
  };

  Vec3f low;  ///< corner of the photons' bounds
  float inverse_width = 0;
  Cell count{1, 1, 1};  ///< cells along each axis, at most 2^21
  Vec3f last;           ///< count - 1

  PHOTONPROOF_ALWAYS_INLINE Cell cell(float x, float y, float z) const {
    return {along(x, low.x, last.x), along(y, low.y, last.y), along(z, low.z, last.z)};
  }

  /// Cells in the order in which photons are kept: x fastest, then y, then z.
  PHOTONPROOF_ALWAYS_INLINE std::uint64_t key(const Cell& c) const {
    return row(c.y, c.z) * static_cast<std::uint64_t>(count.x) + static_cast<std::uint64_t>(c.x);
  }
  /// Index of the row of cells along x.
  PHOTONPROOF_ALWAYS_INLINE std::uint64_t row(std::int32_t y, std::int32_t z) const {
    return static_cast<std::uint64_t>(z) * static_cast<std::uint64_t>(count.y) + static_cast<std::uint64_t>(y);
  }
  PHOTONPROOF_ALWAYS_INLINE std::uint64_t cells() const {
    return static_cast<std::uint64_t>(count.x) * static_cast<std::uint64_t>(count.y) *
           static_cast<std::uint64_t>(count.z);
  }

  /// Every cell that can hold a photon at |photon - p|^2 <= radius^2 evaluated in floats.
  PHOTONPROOF_ALWAYS_INLINE Range range(const Vec3f& p, float radius) const {
    const float x = reach(p.x, radius), y = reach(p.y, radius), z = reach(p.z, radius);
    return {cell(p.x - x, p.y - y, p.z - z), cell(p.x + x, p.y + y, p.z + z)};
  }

 private:
  PHOTONPROOF_ALWAYS_INLINE std::int32_t along(float at, float from, float last_cell) const {
    // A maximum and a minimum as the machine has them, which turn what is not a number into 0.
    const float cell = (at - from) * inverse_width;
    const float not_negative = cell > 0.0f ? cell : 0.0f;
    const float clamped = not_negative < last_cell ? not_negative : last_cell;
    return static_cast<std::int32_t>(clamped);
  }
  PHOTONPROOF_ALWAYS_INLINE static float reach(float at, float radius) {
    const float magnitude = at < 0 ? -at : at;
    // Squares that overflow compare equal at any distance.
    return radius * radius <= std::numeric_limits<float>::max()
               ? radius * (1 + 0x1p-20f) + magnitude * 0x1p-22f + 0x1p-60f
               : std::numeric_limits<float>::infinity();
  }
};

}  // namespace photonproof::inline renderer_photons
