// Sums the flux of the photons around a point, in blocks of sixteen with sixteen partial sums, added in one fixed tree.
// The order of the additions, and so the result to the last bit, does not depend on the width of the machine's vectors.
// Vectors are as wide as lane.h's packs, but written in the extensions that GCC and Clang share. Packs give the same
// bits here in two to eight times the time. As photon_view.h, for inclusion by kernels for several instruction sets.
#pragma once

#include <cstring>
#include <experimental/simd>

#include "renderer/lanes/always_inline.h"
#include "renderer/lanes/lane.h"
#include "renderer/photons/photon_view.h"

namespace photonproof::inline renderer_photons {

struct GatheredFlux {
  Rgb flux{0.0f};  ///< W
  std::int32_t count = 0;
};

/// Photons that landed on `surface` after at most `max_edges` edges, on the point's surface side as far as `test`
/// compares it.
struct PhotonFilter {
  std::uint32_t surface;
  std::int32_t max_edges;
  SheetTest test = SheetTest::none;
  std::uint32_t surface_side = 0;
};

namespace gathering {

constexpr std::size_t width = std::experimental::native_simd<float>::size(), block = 16, parts = block / width;
static_assert(block <= Photons::padding);
using Floats [[gnu::vector_size(width * sizeof(float))]] = float;
using Ints [[gnu::vector_size(width * sizeof(float))]] = std::int32_t;  // a mask is all ones or all zeros

template <class Words, class Word>
PHOTONPROOF_ALWAYS_INLINE Words load(const Word* from) {
  Words words;
  std::memcpy(&words, from, sizeof words);
  return words;
}

/// The sum of sixteen partial ones.
template <class Words, class Word>
PHOTONPROOF_ALWAYS_INLINE Word sum(const Words* partial, Word zero) {
  Word s[block] = {zero};
  std::memcpy(s, partial, sizeof s);
  for (int k = 0; k < 8; ++k) s[k] += s[k + 8];
  for (int k = 0; k < 4; ++k) s[k] += s[k + 4];
  return (s[0] + s[2]) + (s[1] + s[3]);
}

/// The point, normal and filter with which photons are compared.
template <SheetTest test>
struct Look {
  Vec3f p, normal;
  float radius2, height;
  std::int32_t surface, last_word, side;

  PHOTONPROOF_ALWAYS_INLINE Look(const Vec3f& at, float radius, const PhotonFilter& filter)
      : p(at),
        radius2(radius * radius),
        height(sheet_height * radius),
        surface(static_cast<std::int32_t>(filter.surface)),
        side(static_cast<std::int32_t>(filter.surface_side & SurfaceSide::from_behind)) {
    if constexpr (test == SheetTest::side_and_normal) normal = unit_side_normal(filter.surface_side);
    // Edges are a word's highest bits, so words up to this one have few enough.
    constexpr std::int32_t most = SurfaceSide::most_edges;
    const std::int32_t edges = filter.max_edges < most ? filter.max_edges : most;
    last_word = edges < 0 ? -1 : edges * (1 << SurfaceSide::edges_shift) + static_cast<std::int32_t>(SurfaceSide::mask);
  }

  /// Which of the photons from `at` on count.
  PHOTONPROOF_ALWAYS_INLINE Ints counts(const PhotonView& map, std::size_t at) const {
    const Floats dx = load<Floats>(map.x + at) - p.x, dy = load<Floats>(map.y + at) - p.y,
                 dz = load<Floats>(map.z + at) - p.z;
    const Ints landed_on = load<Ints>(map.surface + at), surface_side = load<Ints>(map.surface_side + at);
    Ints counted = (dx * dx + dy * dy + dz * dz <= radius2) & (landed_on == surface) & (surface_side <= last_word);
    if constexpr (test != SheetTest::none) {
      counted &= (surface_side & static_cast<std::int32_t>(SurfaceSide::from_behind)) == side;
    }
    if constexpr (test == SheetTest::side_and_normal) {
      const auto to_floats = [](const Ints& words)
                                 PHOTONPROOF_INLINE_LAMBDA { return __builtin_convertvector(words, Floats); };
      const SideNormal<Floats> n = side_normal<Floats>(surface_side, to_floats);
      const Floats cosine = n.x * normal.x + n.y * normal.y + n.z * normal.z;
      const Floats least = (n.x * n.x + n.y * n.y + n.z * n.z) * (least_side_cosine * least_side_cosine);
      const Floats above = dx * normal.x + dy * normal.y + dz * normal.z;
      counted &= (cosine > 0.0f) & (cosine * cosine >= least) & (above <= height) & (above >= -height);
    }
    return counted;
  }
};

template <SheetTest test>
PHOTONPROOF_ALWAYS_INLINE GatheredFlux gather_by(const PhotonView& map, const Vec3f& p, float radius,
                                                 const PhotonFilter& filter) {
  const Look<test> look(p, radius, filter);
  constexpr std::int32_t numbers[block] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  Floats red[parts] = {}, green[parts] = {}, blue[parts] = {};
  Ints count[parts] = {};
  map.for_each_run(p, radius, [&](std::size_t begin, std::size_t end) PHOTONPROOF_INLINE_LAMBDA {
    for (std::size_t i = begin; i < end; i += block) {
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t at = i + part * width;
        const Ints lane = load<Ints>(numbers + part * width);
        const Ints counted = look.counts(map, at) & (lane < static_cast<std::int32_t>(end - i));
        const auto where_counted = [&](const float* from) PHOTONPROOF_INLINE_LAMBDA {
          return reinterpret_cast<Floats>(load<Ints>(from + at) & counted);
        };
        red[part] += where_counted(map.red);
        green[part] += where_counted(map.green);
        blue[part] += where_counted(map.blue);
        count[part] -= counted;
      }
    }
  });
  return {{sum(red, 0.0f), sum(green, 0.0f), sum(blue, 0.0f)}, sum(count, 0)};
}

}  // namespace gathering

/// The photons with distance_squared(i, p) <= radius * radius that pass the filter.
PHOTONPROOF_ALWAYS_INLINE GatheredFlux gather(const PhotonView& map, const Vec3f& p, float radius,
                                              const PhotonFilter& filter) {
  switch (filter.test) {
    case SheetTest::side:
      return gathering::gather_by<SheetTest::side>(map, p, radius, filter);
    case SheetTest::side_and_normal:
      return gathering::gather_by<SheetTest::side_and_normal>(map, p, radius, filter);
    default:
      return gathering::gather_by<SheetTest::none>(map, p, radius, filter);
  }
}

}  // namespace photonproof::inline renderer_photons
