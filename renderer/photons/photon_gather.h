// Sums the flux of the photons around a point, in blocks of sixteen with sixteen partial sums, added in one fixed tree:
// the order of the additions, and so the result to the last bit, does not depend on how wide the machine's vectors are.
// Written in the vector extensions that GCC and Clang share, which become whatever vectors the target has, and, as
// photon_view.h, for inclusion by kernels for several instruction sets.
#pragma once

#include <cstring>

#include "renderer/lanes/always_inline.h"
#include "renderer/photons/photon_view.h"

namespace photonproof {

struct GatheredFlux {
  Rgb flux{0.0f};  ///< W
  std::int32_t count = 0;
};

/// Photons that landed on `surface` after at most `max_edges` edges, on the point's sheet as far as `test` asks.
struct PhotonFilter {
  std::uint32_t surface;
  std::int32_t max_edges;
  SheetTest test = SheetTest::none;
  std::uint32_t sheet = 0;
};

/// The photons with distance_squared(i, p) <= radius * radius that pass the filter, whose test is `test`.
template <SheetTest test>
PHOTONPROOF_ALWAYS_INLINE GatheredFlux gather_by(const PhotonView& map, const Vec3f& p, float radius,
                                                 const PhotonFilter& filter) {
#if defined(__AVX512F__)
  constexpr std::size_t width = 16;
#elif defined(__AVX2__)
  constexpr std::size_t width = 8;
#else
  constexpr std::size_t width = 4;
#endif
  constexpr std::size_t block = 16, parts = block / width;
  static_assert(block <= Photons::padding);
  using Floats [[gnu::vector_size(width * sizeof(float))]] = float;
  using Ints [[gnu::vector_size(width * sizeof(float))]] = std::int32_t;  // a mask is all ones or all zeros
  const auto load = [](auto& to, const auto* from) PHOTONPROOF_INLINE_LAMBDA { std::memcpy(&to, from, sizeof to); };

  const float radius2 = radius * radius;
  const auto surface = static_cast<std::int32_t>(filter.surface);
  const auto to_floats = [](const Ints& words)
                             PHOTONPROOF_INLINE_LAMBDA { return __builtin_convertvector(words, Floats); };
  // Edges are a word's highest bits: words up to this one have few enough.
  const std::int32_t most_edges = filter.max_edges < static_cast<std::int32_t>(PhotonSheet::most_edges)
                                      ? filter.max_edges
                                      : PhotonSheet::most_edges;
  const std::int32_t last_word =
      most_edges < 0 ? -1 : most_edges * (1 << PhotonSheet::edges_shift) + static_cast<std::int32_t>(PhotonSheet::mask);
  const auto side = static_cast<std::int32_t>(filter.sheet & PhotonSheet::from_behind);
  [[maybe_unused]] const Vec3f normal = unit_sheet_normal(filter.sheet);
  [[maybe_unused]] const float height = sheet_height * radius;
  constexpr std::int32_t numbers[block] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  Floats red[parts] = {}, green[parts] = {}, blue[parts] = {};
  Ints count[parts] = {};
  map.for_each_run(p, radius, [&](std::size_t begin, std::size_t end) PHOTONPROOF_INLINE_LAMBDA {
    for (std::size_t i = begin; i < end; i += block) {
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t at = i + part * width;
        Floats dx, dy, dz, r, g, b;
        Ints landed_on, sheet, lane;
        load(dx, map.x + at);
        load(dy, map.y + at);
        load(dz, map.z + at);
        load(landed_on, map.surface + at);
        load(sheet, map.sheet + at);
        load(r, map.red + at);
        load(g, map.green + at);
        load(b, map.blue + at);
        load(lane, numbers + part * width);
        dx -= p.x;
        dy -= p.y;
        dz -= p.z;
        Ints counts = (dx * dx + dy * dy + dz * dz <= radius2) & (landed_on == surface) & (sheet <= last_word) &
                      (lane < static_cast<std::int32_t>(end - i));
        if constexpr (test != SheetTest::none) {
          counts &= (sheet & static_cast<std::int32_t>(PhotonSheet::from_behind)) == side;
        }
        if constexpr (test == SheetTest::side_and_normal) {
          const SheetNormal<Floats> n = sheet_normal<Floats>(sheet, to_floats);
          const Floats cosine = n.x * normal.x + n.y * normal.y + n.z * normal.z;
          const Floats least = (n.x * n.x + n.y * n.y + n.z * n.z) * (least_sheet_cosine * least_sheet_cosine);
          const Floats above = dx * normal.x + dy * normal.y + dz * normal.z;
          counts &= (cosine > 0.0f) & (cosine * cosine >= least) & (above <= height) & (above >= -height);
        }
        red[part] += reinterpret_cast<Floats>(reinterpret_cast<Ints>(r) & counts);
        green[part] += reinterpret_cast<Floats>(reinterpret_cast<Ints>(g) & counts);
        blue[part] += reinterpret_cast<Floats>(reinterpret_cast<Ints>(b) & counts);
        count[part] -= counts;
      }
    }
  });
  const auto sum = [](const auto* lanes, auto zero) PHOTONPROOF_INLINE_LAMBDA {
    decltype(zero) s[block];
    std::memcpy(s, lanes, sizeof s);
    for (int k = 0; k < 8; ++k) s[k] += s[k + 8];
    for (int k = 0; k < 4; ++k) s[k] += s[k + 4];
    return (s[0] + s[2]) + (s[1] + s[3]);
  };
  return {{sum(red, 0.0f), sum(green, 0.0f), sum(blue, 0.0f)}, sum(count, 0)};
}

/// The photons with distance_squared(i, p) <= radius * radius that pass the filter.
PHOTONPROOF_ALWAYS_INLINE GatheredFlux gather(const PhotonView& map, const Vec3f& p, float radius,
                                              const PhotonFilter& filter) {
  switch (filter.test) {
    case SheetTest::side:
      return gather_by<SheetTest::side>(map, p, radius, filter);
    case SheetTest::side_and_normal:
      return gather_by<SheetTest::side_and_normal>(map, p, radius, filter);
    default:
      return gather_by<SheetTest::none>(map, p, radius, filter);
  }
}

}  // namespace photonproof
