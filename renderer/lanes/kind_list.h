// A closed set of kinds that are structs of floats, or of packs: `Kind<float>` is a record of the scene, `Kind<F>` the
// same for every lane.
#pragma once

#include <algorithm>
#include <cstdint>
#include <variant>

namespace photonproof::inline renderer_lanes {

template <template <class> class... Kind>
struct KindList {
  static constexpr std::uint32_t count = sizeof...(Kind);
  using Variant = std::variant<Kind<float>...>;
  /// The kinds first, so that a record's index is its kind, then others.
  template <class... Other>
  using VariantWith = std::variant<Kind<float>..., Other...>;
  /// Floats of the largest record: the distance between records in the kernels' tables.
  static constexpr std::uint32_t stride = std::max({sizeof(Kind<float>)...}) / sizeof(float);

  /// f.template operator()<Kind>(index) for every kind in order.
  template <class Fn>
  static constexpr void for_each(Fn&& f) {
    std::uint32_t index = 0;
    (f.template operator()<Kind>(index++), ...);
  }
};

}  // namespace photonproof::inline renderer_lanes
