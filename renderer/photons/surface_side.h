// The test whether a photon near a point landed on the same lit side. Distance and surface alone do not decide this. A
// mesh is one surface with many planes, and a thin slab has its lit face within the radius of the dark one. So a photon
// keeps the surface side it landed on, in one word with its path's edges. The word has the surface's front normal
// there, octahedral (Meyer et al. 2010) in 2 x 10 bits, at most 0.24 degrees off, and whether the photon came from
// behind. A gather counts photons of the same side, of normals at most 41 degrees apart, and within a quarter of the
// radius of its tangent plane. It divides by the area of just these points of the surface (gather_area.h). Both use the
// same rounded normals, so the quotient's mean is the irradiance's for any bounds. Kernels include this file.
#pragma once

#include <cstdint>

#include "renderer/lanes/always_inline.h"
#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_photons {

/// Bits of a word, from the highest used: path edges (10), from behind (1), normal (20). Never negative as an int.
struct SurfaceSide {
  static constexpr std::uint32_t most_edges = 1023;  ///< longer paths count as this long
  static constexpr int edges_shift = 21;
  static constexpr std::uint32_t from_behind = 1u << 20;
  static constexpr std::uint32_t mask = (1u << edges_shift) - 1;  ///< all except the edges
  static constexpr int normal_bits = 10;                          ///< along an axis
  static constexpr int normal_steps = (1 << (normal_bits - 1)) - 1;
};

/// The part of the surface side that a gather compares; properties constant over a surface need no test.
enum class SheetTest : std::uint8_t { none, side, side_and_normal };

inline constexpr float least_side_cosine = 0.75f;  ///< of the angle between the normals
inline constexpr float sheet_height = 0.25f;       ///< of the radius: the largest distance to the tangent plane

/// A direction, octahedral, in 2 x `bits` bits.
template <int bits, class F>
PHOTONPROOF_ALWAYS_INLINE UInt<F> octahedral_word(const Vec3<F>& direction) {
  constexpr float steps = (1 << (bits - 1)) - 1;
  const F scale = F(steps) / (lane_abs(direction.x) + lane_abs(direction.y) + lane_abs(direction.z));
  const F x = direction.x * scale, y = direction.y * scale;
  const Mask<F> below = direction.z < 0;
  const F u = select(below, lane_copysign(F(F(steps) - lane_abs(y)), x), x);
  const F v = select(below, lane_copysign(F(F(steps) - lane_abs(x)), y), y);
  return to_uint(F(u + (steps + 0.5f))) * (1u << bits) + to_uint(F(v + (steps + 0.5f)));
}

/// `front`: the surface's geometric normal, unit. `shading`: the normal at the hit, on the back where that was hit.
template <class F>
PHOTONPROOF_ALWAYS_INLINE UInt<F> side_word(const Vec3<F>& front, const Vec3<F>& shading) {
  const UInt<F> behind = select(dot(front, shading) < 0, UInt<F>(SurfaceSide::from_behind), UInt<F>(0u));
  return behind + octahedral_word<SurfaceSide::normal_bits>(front);
}

/// The word with the edges of the photon's path from the light.
template <class F>
PHOTONPROOF_ALWAYS_INLINE UInt<F> with_edges(const UInt<F>& surface_side, const UInt<F>& edges) {
  const UInt<F> most(SurfaceSide::most_edges);
  return select(as_mask<F>(edges < most), edges, most) * (1u << SurfaceSide::edges_shift) + surface_side;
}

/// The front normal of a word, not unit: whole numbers of magnitude 511 at most, so that its square is exact. `words`
/// is an int, or a vector of them, `to_floats` converts those.
template <class Floats>
struct SideNormal {
  Floats x, y, z;
};
template <class Floats, class Ints, class ToFloats>
PHOTONPROOF_ALWAYS_INLINE SideNormal<Floats> side_normal(const Ints& words, const ToFloats& to_floats) {
  constexpr float steps = SurfaceSide::normal_steps;
  const Floats zero{};
  Floats x = to_floats(Ints((words >> 10) & 1023)) - steps;
  Floats y = to_floats(Ints(words & 1023)) - steps;
  const Floats z = steps - (x > zero ? x : -x) - (y > zero ? y : -y);
  const Floats fold = z < zero ? z : zero;
  x += x >= zero ? fold : -fold;
  y += y >= zero ? fold : -fold;
  return {x, y, z};
}
PHOTONPROOF_ALWAYS_INLINE Vec3f side_normal(std::uint32_t word) {
  const auto n = side_normal<float>(static_cast<std::int32_t>(word),
                                    [](std::int32_t i) PHOTONPROOF_INLINE_LAMBDA { return static_cast<float>(i); });
  return {n.x, n.y, n.z};
}
/// The same, unit.
PHOTONPROOF_ALWAYS_INLINE Vec3f unit_side_normal(std::uint32_t word) {
  const Vec3f n = side_normal(word);
  return n * (1 / lane_sqrt(n.x * n.x + n.y * n.y + n.z * n.z));
}
/// Unit normal of the side that was hit.
inline Vec3f facing_side_normal(std::uint32_t word) {
  const Vec3f n = unit_side_normal(word);
  return (word & SurfaceSide::from_behind) != 0 ? -n : n;
}

}  // namespace photonproof::inline renderer_photons
