// Russian roulette (Arvo and Kirk 1990), one rule for every integrator. Let T be the throughput of a path of k edges
// relative to its start. The path survives with probability q, and then T becomes T/q.
//   `q = T`             where T < 1 - 2^-14.
//   `q = min(T, m(k))`  elsewhere. The cap m(k) is 1 up to k0 edges and 1 - c/k beyond.
//
// In the first case the albedo itself decides absorption and T stays 1. In a closed room of albedo r that emits e, the
// light e sum r^k = e/(1-r) is estimated by e times the length. The length is geometrically distributed: the relative
// variance of a path is r, its cost 1/(1-r). (No survival S(k) does much better. The variance is nearly
// 2/(1-r) sum r^2k/S(k), the cost sum S(k). By Cauchy and Schwarz their product is least for S(k) = r^k.)
//
// Without absorption paths would never end: a lossless closed room, total reflection around a light in glass. A
// constant share s that dies each time is no solution. T grows as (r/(1-s))^k, whose variance is infinite from r^2 =
// 1-s on, and error estimates from finite samples are then meaningless. So the share falls as c/k. Survival beyond k0
// is (k0/k)^c. For c > 1 the expected length is finite, at most k0 c/(c-1) = 3 k0. For any r < 1 the variance is
// finite, too. Relative to the mean's square it is 31 at r = 1 - 2^-14, then about 2 Gamma(c+1) / 2^(c+1) / ((1-r)
// k0)^c. Absorption of 2^-14 per edge or more needs no cap, since it ends paths after 16,384 edges.
//
// Light that enters lossless glass or clouds from outside rarely reaches k0 edges. Its mean path in there is four times
// volume over surface (Blanco and Fournier 2003), times the squared index, however it is reflected or scattered.
#pragma once

#include <algorithm>

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lanes {

/// Survival probability of paths of `edges` >= rr_depth edges that have `weight` > 0 relative to their first.
template <class F>
F survival_probability(const F& weight, const UInt<F>& edges, int rr_depth) {
  constexpr int gentle_until = 1024;
  constexpr float c = 1.5f, ends_by_itself = 1 - 0x1p-14f;
  const F k = to_float(edges);
  const auto is_gentle = k > static_cast<float>(std::max(gentle_until, rr_depth)) && weight >= ends_by_itself;
  return lane_min(weight, select(is_gentle, F(1 - c / k), F(1.0f)));
}

}  // namespace photonproof::inline renderer_lanes
