// Random numbers as values: each is a function of (key, index, dimension), never of a thread, a lane or a batch. The
// key names a pixel's or a photon map's sequence. The index is the sample's or the photon's number in it, the dimension
// the purpose of the number.
//   `sobol`        Owen-scrambled (0,2)-sequences, one per dimension, shuffled against each other ("padded"). Source:
//                  Burley 2020, "Practical Hash-based Owen Scrambling"; Vegdahl's 2021 constants for the
//                  permutation of Laine and Karras 2011.
//   `independent`  Every number hashed by itself (Jarzynski and Olano 2020, pcg4d): to check the other against.
#pragma once

#include <cstdint>

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lanes {

enum class SamplerKind : std::uint32_t { sobol, independent };

/// The purpose of a key, a number that its owner chooses: keys of different streams coincide only by chance.
enum class Stream : std::uint64_t {};

/// A permutation of the 32-bit integers in which every input bit moves every output bit (Wellons's search, 2018).
template <class U>
U mix_bits(U x) {
  x ^= x >> 16;
  x *= 0x21f0aaadu;
  x ^= x >> 15;
  x *= 0xd35a2d97u;
  x ^= x >> 15;
  return x;
}

template <class U>
U reverse_bits(U x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

/// Owen scrambling of a number whose bits are reversed: a bit is flipped by a hash of the less significant ones.
template <class U>
U scramble_reversed(U x, const U& seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// The second dimension of Sobol's sequence at point i, bits reversed. Its generator matrix is Pascal's triangle mod 2;
/// by Lucas's theorem bit k of the result is the sum of the bits of i whose positions contain k's bits.
template <class U>
U sobol_second_reversed(U i) {
  i ^= (i >> 1) & 0x55555555u;
  i ^= (i >> 2) & 0x33333333u;
  i ^= (i >> 4) & 0x0f0f0f0fu;
  i ^= (i >> 8) & 0x00ff00ffu;
  i ^= i >> 16;
  return i;
}

/// In [0,1), from the upper 24 bits.
template <class F>
F to_unit(const UInt<F>& bits) {
  return to_float(UInt<F>(bits >> 8)) * 0x1p-24f;
}

/// Uniform in [0,1), independent of every other number.
template <class F>
F draw_independent(const UInt<F>& key, const UInt<F>& index, const UInt<F>& dimension) {
  return to_unit<F>(mix_bits(UInt<F>(mix_bits(UInt<F>(key + dimension * 0x9e3779b9u)) ^ (index * 0x85ebca6bu))));
}

template <class F>
Vec2<F> draw_pcg4d(const UInt<F>& key, const UInt<F>& index, const UInt<F>& dimension) {
  using U = UInt<F>;
  U x = key * 1664525u + 1013904223u;
  U y = index * 1664525u + 1013904223u;
  U z = dimension * 1664525u + 1013904223u;
  U w = U(0xa511e9b3u);
  for (int round = 0; round < 2; ++round) {
    x += y * w;
    y += z * x;
    z += x * y;
    w += y * z;
    if (round > 0) break;
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
    w ^= w >> 16;
  }
  return {to_unit<F>(x), to_unit<F>(y)};
}

/// Uniform in [0,1)^2.
template <class F>
Vec2<F> draw2(SamplerKind kind, const UInt<F>& key, const UInt<F>& index, const UInt<F>& dimension) {
  using U = UInt<F>;
  if (kind == SamplerKind::independent) return draw_pcg4d<F>(key, index, dimension);
  const U seed = mix_bits(U(key + dimension * 0x9e3779b9u));
  const U shuffled = reverse_bits(scramble_reversed(reverse_bits(index), seed));
  const U x = scramble_reversed(shuffled, U(seed * 0x2c1b3c6du + 0x297a2d39u));
  const U y = scramble_reversed(sobol_second_reversed(shuffled), U((seed ^ 0x6c8e9cf5u) * 0x1b56c4e9u));
  return {to_unit<F>(reverse_bits(x)), to_unit<F>(reverse_bits(y))};
}

/// The seed of a stream. `block` separates parts that have the same indices (a photon's number above 2^32).
inline std::uint32_t stream_seed(std::uint64_t seed, Stream stream, std::uint64_t block = 0) {
  const auto half = [](std::uint64_t v, int which) { return static_cast<std::uint32_t>(v >> (32 * which)); };
  std::uint32_t h = mix_bits(half(seed, 0) + 0x9e3779b9u);
  h = mix_bits(h ^ half(seed, 1));
  h = mix_bits(h + static_cast<std::uint32_t>(stream) * 0x85ebca6bu);
  h = mix_bits(h ^ half(block, 0));
  return mix_bits(h + half(block, 1));
}

/// The key of a pixel's samples, x, y < 2^16, in the stream of that seed.
template <class F>
UInt<F> pixel_key(const UInt<F>& x, const UInt<F>& y, std::uint32_t seed) {
  return mix_bits(UInt<F>(mix_bits(UInt<F>(y << 16 | x)) + seed));
}

}  // namespace photonproof::inline renderer_lanes
