// The functions of lane.h for SIMD packs (std::experimental::simd). Only this file depends on instruction sets. Only
// lane.h includes it, before the templates that call these.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#include <array>
#include <experimental/simd>

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lanes {

namespace stdx = std::experimental;

template <class A>
struct LaneTraits<stdx::simd<float, A>> {
  using UInt = stdx::rebind_simd_t<std::uint32_t, stdx::simd<float, A>>;
  using Mask = stdx::simd_mask<float, A>;
  static constexpr std::size_t width = stdx::simd<float, A>::size();
};

template <class A>
using Pack = stdx::simd<float, A>;
template <class A>
using UIntPack = UInt<Pack<A>>;

// --- masks and choice ------------------------------------------------------------------------------------------------

template <class F, class T, class A>
Mask<F> as_mask(const stdx::simd_mask<T, A>& m) {
  return stdx::__proposed::static_simd_cast<Mask<F>>(m);
}

template <class T, class A>
bool any(const stdx::simd_mask<T, A>& m) {
  return stdx::any_of(m);
}

template <class T, class A>
bool all(const stdx::simd_mask<T, A>& m) {
  return stdx::all_of(m);
}

template <class A>
std::uint32_t to_bits(const stdx::simd_mask<float, A>& m) {
  return static_cast<std::uint32_t>(m.__to_bitset().to_ulong());  // libstdc++'s own; the TS has no portable way
}

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

// --- arithmetic ------------------------------------------------------------------------------------------------------

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

template <class A>
Pack<A> lane_sqrt(const Pack<A>& a) {
  return stdx::sqrt(a);
}

template <class A>
Pack<A> lane_abs(const Pack<A>& a) {
  return stdx::abs(a);
}

template <class A>
Pack<A> lane_copysign(const std::type_identity_t<Pack<A>>& a, const Pack<A>& b) {
  return stdx::copysign(a, b);
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

template <class U>
auto to_float(const U& i) -> stdx::rebind_simd_t<float, U> {
  using I = stdx::rebind_simd_t<std::int32_t, U>;
  return stdx::static_simd_cast<stdx::rebind_simd_t<float, U>>(stdx::static_simd_cast<I>(i));
}

template <class A>
UIntPack<A> to_uint(const Pack<A>& v) {
  using I = stdx::rebind_simd_t<std::int32_t, Pack<A>>;
  return stdx::static_simd_cast<UIntPack<A>>(stdx::static_simd_cast<I>(v));
}

// --- memory ----------------------------------------------------------------------------------------------------------

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

template <class T, class A>
T lane_of(const stdx::simd<T, A>& v, std::size_t lane) {
  return v[lane];
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
}  // namespace photonproof::inline renderer_lanes
