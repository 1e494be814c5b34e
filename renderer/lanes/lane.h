// The lane type: code that shades, samples and intersects is a template over F, which is `float` (one history, the
// readable form and the tests' oracle) or a SIMD pack of floats, one history a lane (std::experimental::simd). What
// follows is what F needs beyond operators, overloaded for both. Only this file knows instruction sets.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <experimental/simd>
#include <type_traits>

#include "scenes/meshes/vec.h"

namespace photonproof {

namespace stdx = std::experimental;

template <class F>
struct LaneTraits;
template <>
struct LaneTraits<float> {
  using UInt = std::uint32_t;
  using Mask = bool;
  static constexpr std::size_t width = 1;
};
template <class A>
struct LaneTraits<stdx::simd<float, A>> {
  using UInt = stdx::rebind_simd_t<std::uint32_t, stdx::simd<float, A>>;
  using Mask = stdx::simd_mask<float, A>;
  static constexpr std::size_t width = stdx::simd<float, A>::size();
};

template <class F>
using UInt = typename LaneTraits<F>::UInt;  ///< 32-bit integer a lane: indices, counters, random bits
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

template <class A>
using Pack = stdx::simd<float, A>;
template <class A>
using UIntPack = UInt<Pack<A>>;

// --- masks: always those of F, whatever was compared -----------------------------------------------------------------

template <class F>
Mask<F> as_mask(bool m) {
  return Mask<F>(m);
}
template <class F, class T, class A>
Mask<F> as_mask(const stdx::simd_mask<T, A>& m) {
  return stdx::__proposed::static_simd_cast<Mask<F>>(m);
}
template <class F>
Mask<F> equal(const UInt<F>& a, const UInt<F>& b) {
  return as_mask<F>(a == b);
}

inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }
template <class T, class A>
bool any(const stdx::simd_mask<T, A>& m) {
  return stdx::any_of(m);
}
template <class T, class A>
bool all(const stdx::simd_mask<T, A>& m) {
  return stdx::all_of(m);
}

/// Bit i is lane i.
inline std::uint32_t to_bits(bool m) { return m ? 1 : 0; }
template <class A>
std::uint32_t to_bits(const stdx::simd_mask<float, A>& m) {
  return static_cast<std::uint32_t>(m.__to_bitset().to_ulong());  // libstdc++'s own; the TS has no portable way
}

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
template <class A>
Pack<A> select(const stdx::simd_mask<float, A>& m, const std::type_identity_t<Pack<A>>& a,
               const std::type_identity_t<Pack<A>>& b) {
  Pack<A> r = b;
  stdx::where(m, r) = a;
  return r;
}
template <class A>
UIntPack<A> select(const stdx::simd_mask<float, A>& m, const std::type_identity_t<UIntPack<A>>& a,
                   const std::type_identity_t<UIntPack<A>>& b) {
  UIntPack<A> r = b;
  stdx::where(stdx::__proposed::static_simd_cast<typename UIntPack<A>::mask_type>(m), r) = a;
  return r;
}
template <class M, class F>
Vec3<F> select(const M& m, const Vec3<F>& a, const Vec3<F>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

// --- arithmetic ------------------------------------------------------------------------------------------------------

// a < b ? a : b, as the hardware's instruction: with a NaN the result is b.
inline float lane_min(float a, float b) { return a < b ? a : b; }
inline float lane_max(float a, float b) { return a > b ? a : b; }
template <class A>
Pack<A> lane_min(const Pack<A>& a, const std::type_identity_t<Pack<A>>& b) {
#if defined(__AVX512F__)
  if constexpr (Pack<A>::size() == 16) return Pack<A>(_mm512_min_ps(static_cast<__m512>(a), static_cast<__m512>(b)));
#endif
  return select(a < b, a, b);  // one instruction; stdx::min may take its operands in either order
}
template <class A>
Pack<A> lane_max(const Pack<A>& a, const std::type_identity_t<Pack<A>>& b) {
#if defined(__AVX512F__)
  if constexpr (Pack<A>::size() == 16) return Pack<A>(_mm512_max_ps(static_cast<__m512>(a), static_cast<__m512>(b)));
#endif
  return select(a > b, a, b);
}
inline float lane_sqrt(float a) { return std::sqrt(a); }
template <class A>
Pack<A> lane_sqrt(const Pack<A>& a) {
  return stdx::sqrt(a);
}
inline float lane_abs(float a) { return std::abs(a); }
template <class A>
Pack<A> lane_abs(const Pack<A>& a) {
  return stdx::abs(a);
}
inline float lane_copysign(float a, float b) { return std::copysign(a, b); }
template <class A>
Pack<A> lane_copysign(const std::type_identity_t<Pack<A>>& a, const Pack<A>& b) {
  return stdx::copysign(a, b);
}

/// a b + c, with one rounding where the instruction set has it.
inline float mul_add(float a, float b, float c) {
#if defined(__FMA__) || defined(__aarch64__)
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}
template <class A>
Pack<A> mul_add(const Pack<A>& a, const std::type_identity_t<Pack<A>>& b, const std::type_identity_t<Pack<A>>& c) {
  [[maybe_unused]] constexpr std::size_t n = Pack<A>::size();
#if defined(__AVX512F__)
  if constexpr (n == 16)
    return Pack<A>(_mm512_fmadd_ps(static_cast<__m512>(a), static_cast<__m512>(b), static_cast<__m512>(c)));
#endif
#if defined(__FMA__)
  if constexpr (n == 8)
    return Pack<A>(_mm256_fmadd_ps(static_cast<__m256>(a), static_cast<__m256>(b), static_cast<__m256>(c)));
#elif defined(__aarch64__)
  if constexpr (n == 4)
    return Pack<A>(vfmaq_f32(static_cast<float32x4_t>(c), static_cast<float32x4_t>(a), static_cast<float32x4_t>(b)));
#endif
  return a * b + c;
}

/// The float nearest to an integer below 2^24.
inline float to_float(std::uint32_t i) { return static_cast<float>(i); }
template <class U>
auto to_float(const U& i) -> stdx::rebind_simd_t<float, U> {
  using I = stdx::rebind_simd_t<std::int32_t, U>;
  return stdx::static_simd_cast<stdx::rebind_simd_t<float, U>>(stdx::static_simd_cast<I>(i));
}

/// Towards zero, of a value in [0, 2^31).
inline std::uint32_t to_uint(float v) { return static_cast<std::uint32_t>(v); }
template <class A>
UIntPack<A> to_uint(const Pack<A>& v) {
  using I = stdx::rebind_simd_t<std::int32_t, Pack<A>>;
  return stdx::static_simd_cast<UIntPack<A>>(stdx::static_simd_cast<I>(v));
}

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

// --- memory ----------------------------------------------------------------------------------------------------------

/// A word a lane, from or to memory of any kind of 32-bit word: bits are copied, not converted.
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

/// base[index] a lane.
inline float gather(const float* base, std::uint32_t index) { return base[index]; }
inline std::uint32_t gather(const std::uint32_t* base, std::uint32_t index) { return base[index]; }
template <class T, class U>
requires(!std::is_same_v<U, std::uint32_t>) stdx::rebind_simd_t<T, U> gather(const T* base, const U& index) {
  using R = stdx::rebind_simd_t<T, U>;
  static_assert(sizeof(T) == 4);
#if defined(__AVX512F__)
  if constexpr (U::size() == 16) {
    const __m512i lanes = _mm512_i32gather_epi32(static_cast<__m512i>(index), base, 4);
    if constexpr (std::is_same_v<T, float>)
      return R(_mm512_castsi512_ps(lanes));
    else
      return R(lanes);
  }
#elif defined(__AVX2__)
  if constexpr (U::size() == 8) {
    const __m256i lanes = _mm256_i32gather_epi32(reinterpret_cast<const int*>(base), static_cast<__m256i>(index), 4);
    if constexpr (std::is_same_v<T, float>)
      return R(_mm256_castsi256_ps(lanes));
    else
      return R(lanes);
  }
#endif
  return R([&](auto i) { return base[index[i]]; });
}

#if defined(__AVX2__) && !defined(__AVX512F__)
/// compressed_lanes[bits][i] is the i-th lane whose bit is set.
inline constexpr auto compressed_lanes = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::uint32_t bits = 0; bits < 256; ++bits) {
    std::size_t n = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane)
      if ((bits >> lane & 1u) != 0) table[bits][n++] = lane;
  }
  return table;
}();
#endif

/// Writes the lanes whose bit is set one after the other; may write up to a pack's width beyond `out`.
inline void compress_store(float v, std::uint32_t, std::uint32_t* out) { store_from(v, out); }
inline void compress_store(std::uint32_t v, std::uint32_t, std::uint32_t* out) { *out = v; }
template <class T, class A>
void compress_store(const stdx::simd<T, A>& v, std::uint32_t bits, std::uint32_t* out) {
  using V = stdx::simd<T, A>;
#if defined(__AVX512F__)
  if constexpr (V::size() == 16) {
    __m512i lanes;
    if constexpr (std::is_same_v<T, float>)
      lanes = _mm512_castps_si512(static_cast<__m512>(v));
    else
      lanes = static_cast<__m512i>(v);
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), lanes));
    return;
  }
#elif defined(__AVX2__)
  if constexpr (V::size() == 8) {
    __m256i lanes;
    if constexpr (std::is_same_v<T, float>)
      lanes = _mm256_castps_si256(static_cast<__m256>(v));
    else
      lanes = static_cast<__m256i>(v);
    const auto* order = reinterpret_cast<const __m128i*>(compressed_lanes[bits].data());
    lanes = _mm256_permutevar8x32_epi32(lanes, _mm256_cvtepu8_epi32(_mm_loadl_epi64(order)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), lanes);
    return;
  }
#endif
  alignas(stdx::memory_alignment_v<V>) T lanes[V::size()];
  v.copy_to(lanes, stdx::vector_aligned);
  for (; bits != 0; bits &= bits - 1)
    *out++ = std::bit_cast<std::uint32_t>(lanes[static_cast<std::size_t>(std::countr_zero(bits))]);
}

// --- vectors of packs ------------------------------------------------------------------------------------------------

template <class A>
Pack<A> dot(const Vec3<Pack<A>>& a, const Vec3<Pack<A>>& b) {
  return mul_add(a.z, b.z, mul_add(a.y, b.y, a.x * b.x));
}
template <class A>
Pack<A> length(const Vec3<Pack<A>>& a) {
  return lane_sqrt(dot(a, a));
}
template <class A>
Vec3<Pack<A>> normalize(const Vec3<Pack<A>>& a) {
  return a * (1 / length(a));
}
template <class A>
Pack<A> max_component(const Vec3<Pack<A>>& a) {
  return lane_max(a.z, lane_max(a.y, a.x));  // with a NaN what std::max gives
}
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

}  // namespace photonproof
