// Random bits as a function of a number, for values that are made once and stored.
#pragma once

#include <cstdint>

namespace photonproof::inline scenes_base {

/// Number n of splitmix64 (Steele, Lea, Flood 2014) from `start`: different for different n.
constexpr std::uint64_t splitmix64(std::uint64_t start, std::uint64_t n) {
  std::uint64_t z = start + n * 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

}  // namespace photonproof::inline scenes_base
