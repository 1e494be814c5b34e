// The lane type F: code that shades, samples and intersects is a template over it. F is `float` (one path, the readable
// form and the tests' oracle) or a SIMD pack of floats, one path per lane. This file defines the functions that F needs
// beyond operators. For packs lane_pack.h overloads them, in sources that define PHOTONPROOF_PACKS before their first
// include: kernels and their tests. Other sources do not include <experimental/simd>, which would be a third of their
// compile time.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_lanes {

template <class F>
struct LaneTraits;
template <>
struct LaneTraits<float> {
  using UInt = std::uint32_t;
  using Mask = bool;
  static constexpr std::size_t width = 1;
};
template <class F>
using UInt = typename LaneTraits<F>::UInt;  ///< 32-bit integer per lane: indices, counters, random bits
template <class F>
using Mask = typename LaneTraits<F>::Mask;
template <class F>
inline constexpr std::size_t lane_count = LaneTraits<F>::width;

/// For records of columns (core/columns.h): a lane's value of either type.
template <class F>
struct LanesOf {
  template <class T>
  using Column = std::conditional_t<std::is_same_v<T, float>, F, UInt<F>>;
};

/// One word per lane, from or to memory of any kind of 32-bit word: bits are copied, not converted.
template <class V, class Word>
void load_into(V& v, const Word* p) {
  static_assert(sizeof(Word) == 4 && std::is_trivially_copyable_v<V>);
  std::memcpy(static_cast<void*>(&v), p, sizeof v);
}
template <class V, class Word>
void store_from(const V& v, Word* p) {
  static_assert(sizeof(Word) == 4 && std::is_trivially_copyable_v<V>);
  std::memcpy(p, static_cast<const void*>(&v), sizeof v);
}

}  // namespace photonproof::inline renderer_lanes

#ifdef PHOTONPROOF_PACKS
#include "renderer/lanes/lane_pack.h"
#endif

namespace photonproof::inline renderer_lanes {

// --- masks: always those of F, for any compared type -----------------------------------------------------------------

template <class F>
Mask<F> as_mask(bool m) {
  return Mask<F>(m);
}
template <class F>
Mask<F> equal(const UInt<F>& a, const UInt<F>& b) {
  return as_mask<F>(a == b);
}

inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }

/// Bit i is lane i.
inline std::uint32_t to_bits(bool m) { return m ? 1 : 0; }

template <class M>
std::uint64_t count_lanes(const M& m) {
  return static_cast<std::uint64_t>(std::popcount(to_bits(m)));
}

/// Lanes [0, n).
template <class F>
Mask<F> first_lanes(std::size_t n) {
  if constexpr (std::is_same_v<F, float>)
    return n > 0;
  else
    return F([](auto i) { return static_cast<float>(i); }) < static_cast<float>(n);
}

// --- choice ----------------------------------------------------------------------------------------------------------

inline float select(bool m, float a, float b) { return m ? a : b; }
inline std::uint32_t select(bool m, std::uint32_t a, std::uint32_t b) { return m ? a : b; }
template <class M, class F>
Vec3<F> select(const M& m, const Vec3<F>& a, const Vec3<F>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

// --- arithmetic ------------------------------------------------------------------------------------------------------

// a < b ? a : b, as the hardware's instruction: with a NaN the result is b.
inline float lane_min(float a, float b) { return a < b ? a : b; }
inline float lane_max(float a, float b) { return a > b ? a : b; }
inline float lane_sqrt(float a) { return std::sqrt(a); }
inline float lane_abs(float a) { return std::abs(a); }
inline float lane_copysign(float a, float b) { return std::copysign(a, b); }

/// a b + c, with one rounding where the instruction set has it.
inline float mul_add(float a, float b, float c) {
#if defined(__FMA__) || defined(__aarch64__)
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

/// The float nearest to an integer below 2^24.
inline float to_float(std::uint32_t i) { return static_cast<float>(i); }

/// Towards zero, of a value in [0, 2^31).
inline std::uint32_t to_uint(float v) { return static_cast<std::uint32_t>(v); }

/// The bits of a float, and back.
template <class F>
UInt<F> to_word(const F& v) {
  UInt<F> bits;
  static_assert(sizeof bits == sizeof v);
  std::memcpy(static_cast<void*>(&bits), static_cast<const void*>(&v), sizeof v);
  return bits;
}
template <class F>
F from_word(const UInt<F>& bits) {
  F v;
  static_assert(sizeof bits == sizeof v);
  std::memcpy(static_cast<void*>(&v), static_cast<const void*>(&bits), sizeof v);
  return v;
}

/// 0, 1, 2 ...: each lane's number.
template <class F>
UInt<F> lane_index() {
  if constexpr (std::is_same_v<F, float>)
    return 0;
  else
    return UInt<F>([](auto i) { return static_cast<std::uint32_t>(i); });
}

/// base[index] in each lane.
inline float gather(const float* base, std::uint32_t index) { return base[index]; }
inline std::uint32_t gather(const std::uint32_t* base, std::uint32_t index) { return base[index]; }

/// Writes the lanes whose bit is set consecutively; may write up to a pack's width beyond `out`.
inline void compress_store(float v, std::uint32_t, std::uint32_t* out) { store_from(v, out); }
inline void compress_store(std::uint32_t v, std::uint32_t, std::uint32_t* out) { *out = v; }

/// The same vector in every lane.
template <class F>
Vec3<F> broadcast(const Vec3f& v) {
  return {F(v.x), F(v.y), F(v.z)};
}
/// a + s b.
template <class F>
Vec3<F> advance(const Vec3<F>& a, const F& s, const Vec3<F>& b) {
  return {mul_add(b.x, s, a.x), mul_add(b.y, s, a.y), mul_add(b.z, s, a.z)};
}

/// A struct of floats for every lane, gathered from a table of such structs: record `index` starts at base + index x
/// stride. `Record<F>` is `Record<float>` with F for float.
template <template <class> class Record, class F>
Record<F> gather_record(const float* base, const UInt<F>& index, std::uint32_t stride) {
  constexpr std::size_t words = sizeof(Record<float>) / sizeof(float);
  static_assert(sizeof(Record<F>) == words * sizeof(F) && std::is_trivially_copyable_v<Record<F>>);
  const UInt<F> first = index * stride;
  F columns[words];
  for (std::size_t k = 0; k < words; ++k) columns[k] = gather(base + k, first);
  Record<F> record;
  std::memcpy(&record, columns, sizeof record);
  return record;
}

}  // namespace photonproof::inline renderer_lanes
