// The lanes of a mask, one after the other.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace photonproof::inline renderer_rays {

/// Calls visit(lane) for the lanes, in order.
template <class Visit>
void for_each_lane(std::uint32_t lanes, Visit&& visit) {
  for (; lanes != 0; lanes &= lanes - 1) visit(static_cast<std::size_t>(std::countr_zero(lanes)));
}

}  // namespace photonproof::inline renderer_rays
