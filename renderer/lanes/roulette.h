// Russian roulette (Arvo and Kirk 1990), one rule for every integrator. A path of k edges, whose throughput relative
// to what it began with is T, survives with probability
//   q = T                where T < 1 - 2^-14,
//   q = min(T, m(k))     elsewhere, m(k) = 1 up to k0 edges and 1 - c/k beyond,
// and then T becomes T/q.
//
// In the first case absorption is played by the albedo itself and T stays 1. In a closed room of albedo r that shines
// with e, light e sum r^k = e/(1-r) is estimated by e times the length, which is geometrically distributed: a relative
// variance of r a path, at a cost of 1/(1-r). (No survival S(k) does much better: the variance is nearly
// 2/(1-r) sum r^2k/S(k), the cost sum S(k), whose product is least, by Cauchy and Schwarz, for S(k) = r^k.)
//
// Where nothing is absorbed that would never end: a lossless closed room, total reflection around a light in glass. A
// constant share s that dies each time is no way out: T grows as (r/(1-s))^k, whose variance is infinite from
// r^2 = 1-s on, and errors claimed from finite samples then mean nothing. So the share falls as c/k. Survival beyond k0
// is (k0/k)^c; for c > 1 the expected length is finite, at most k0 c/(c-1) = 3 k0; and for any r < 1 so is the
// variance: relative to the mean's square 31 at r = 1 - 2^-14, then about 2 Gamma(c+1) / 2^(c+1) / ((1-r) k0)^c. What
// absorbs 2^-14 an edge or more is spared that, since it ends after 16,384 edges.
//
// Light that enters lossless glass or clouds from outside hardly comes as far as k0: its mean path in there is four
// times volume over surface (Blanco and Fournier 2003), times the squared index, however it is reflected or scattered.
#pragma once

#include <algorithm>

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lanes {

/// For paths of `edges` >= rr_depth edges that have `weight` > 0 relative to their first.
template <class F>
F survival_probability(const F& weight, const UInt<F>& edges, int rr_depth) {
  constexpr int gentle_until = 1024;
  constexpr float c = 1.5f, ends_by_itself = 1 - 0x1p-14f;
  const F k = to_float(edges);
  const auto is_gentle = k > static_cast<float>(std::max(gentle_until, rr_depth)) && weight >= ends_by_itself;
  return lane_min(weight, select(is_gentle, F(1 - c / k), F(1.0f)));
}

}  // namespace photonproof::inline renderer_lanes
