// Single lanes of structs of lanes, for code that handles one lane after the other. `Record<F>` has a column of lanes
// for every word of `Record<float>`.
#pragma once

#include <bit>

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lanes {

inline float lane_of(float v, std::size_t) { return v; }
inline std::uint32_t lane_of(std::uint32_t v, std::size_t) { return v; }
template <template <class> class Record, class F>
Record<float> lane_of(const Record<F>& v, std::size_t lane) {
  constexpr std::size_t words = sizeof(Record<float>) / 4;
  static_assert(sizeof v == words * sizeof(F) && std::is_trivially_copyable_v<Record<F>>);
  const auto* columns = reinterpret_cast<const unsigned char*>(&v);
  Record<float> one;
  auto* to = reinterpret_cast<unsigned char*>(&one);
  for (std::size_t k = 0; k < words; ++k) std::memcpy(to + 4 * k, columns + 4 * (k * lane_count<F> + lane), 4);
  return one;
}

/// Stores one record as a lane of the corresponding struct of lanes.
template <class F, class Lanes, class One>
void set_lane(Lanes& v, std::size_t lane, const One& one) {
  constexpr std::size_t words = sizeof(One) / 4;
  static_assert(sizeof v == words * sizeof(F) && std::is_trivially_copyable_v<Lanes>);
  auto* columns = reinterpret_cast<unsigned char*>(&v);
  const auto* from = reinterpret_cast<const unsigned char*>(&one);
  for (std::size_t k = 0; k < words; ++k) std::memcpy(columns + 4 * (k * lane_count<F> + lane), from + 4 * k, 4);
}

/// The results of one(lane) for each of these lanes, zeros in the others.
template <class Answer, class F, class Ask>
Answer each_lane(const Mask<F>& lanes, const Ask& one) {
  Answer answer{};
  for (std::uint32_t bits = to_bits(lanes); bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    set_lane<F>(answer, lane, one(lane));
  }
  return answer;
}

}  // namespace photonproof::inline renderer_lanes
