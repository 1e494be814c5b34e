// The ellipsoids that a ray enters, in order, some at a time: as "3D Gaussian Ray Tracing" (Moenne-Loccoz et al. 2024)
// keeps them. One traversal finds the nearest few behind the last ones.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "renderer/core/ray.h"

namespace photonproof::inline renderer_rays {

struct CloudEntry {
  float t = -1;                        ///< where the ray enters the ellipsoid or its shell
  std::uint32_t surface = no_index;    ///< index of the surface
  std::uint32_t ellipsoid = no_index;  ///< index in its cloud
  friend auto operator<=>(const CloudEntry&, const CloudEntry&) = default;
  bool is_of_same(const CloudEntry& other) const { return surface == other.surface && ellipsoid == other.ellipsoid; }
};

class CloudEntries {
 public:
  static constexpr std::size_t most = 16;  ///< of a traversal

  /// The nearest entries behind the last ones, by distance and then by index.
  std::span<const CloudEntry> found() const { return {entries_.data(), count_}; }
  /// Goes on behind the entries found; false where there are no more.
  bool advance() {
    if (count_ < most) return false;
    behind_ = entries_[most - 1];
    count_ = 0;
    return true;
  }

  /// Where traversals begin: a little before the last entry, as others may be as far.
  float from() const { return std::max(behind_.t * (1 - 0x1p-22f), 0.0f); }
  /// Whether the entry needs no more attention: it is kept, or is no new one. Else it lies behind those kept.
  bool take(const CloudEntry& entry) {
    // A ray along an edge enters both of the shell's triangles there.
    if (entry < behind_ || entry.is_of_same(behind_)) return true;
    const auto begin = entries_.begin(), end = begin + static_cast<std::ptrdiff_t>(count_);
    const auto same = std::find_if(begin, end, [&](const CloudEntry& other) { return entry.is_of_same(other); });
    if (same != end) {
      if (!(entry < *same)) return true;
      std::copy(same + 1, end, same);
      --count_;
    } else if (count_ == most) {
      if (entries_[most - 1] < entry) return false;
      --count_;
    }
    std::size_t place = count_++;
    for (; place > 0 && entry < entries_[place - 1]; --place) entries_[place] = entries_[place - 1];
    entries_[place] = entry;
    return true;
  }
  /// Leaves out entries behind another surface.
  void end_at(float t) {
    while (count_ > 0 && entries_[count_ - 1].t > t) --count_;
  }

 private:
  std::array<CloudEntry, most> entries_;
  std::size_t count_ = 0;
  CloudEntry behind_;
};

}  // namespace photonproof::inline renderer_rays
