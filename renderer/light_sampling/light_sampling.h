// Choosing a light from the table of light_table.h, one per lane.
#pragma once

#include "renderer/lanes/lane.h"
#include "renderer/light_sampling/light_words.h"

namespace photonproof::inline renderer_light_sampling {

template <class F>
struct LightSampling {
  UInt<F> light;
  F probability;
  UInt<F> primitive;
};

/// Picks a light from the table; `u` is uniform in [0,1).
template <class F>
LightSampling<F> choose_by_flux(const LightWords* first, std::uint32_t light_count, const F& u) {
  const auto count = static_cast<float>(light_count);
  const F scaled = u * count;
  UInt<F> slot = to_uint(lane_min(scaled, F(count - 1)));
  const UInt<F> word = slot * LightWords::stride;
  const F within = scaled - to_float(slot);
  const Mask<F> keep = within < gather(&first->alias_threshold, word);
  slot = select(keep, slot, gather(&first->alias, word));
  const UInt<F> chosen = slot * LightWords::stride;
  return {slot, gather(&first->probability, chosen), gather(&first->primitive, chosen)};
}

}  // namespace photonproof::inline renderer_light_sampling
