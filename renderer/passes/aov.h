// The part of a photon mapper's render that the image shows: all its light, or for teaching a part or the method.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace photonproof::inline renderer_passes {

enum class Aov : std::uint8_t {
  whole,
  direct,
  caustics,
  global,
  indirect,
  photons,
  radius,
  samples,
  cache_records,
  time
};

struct AovRow {
  Aov view;
  const char* name;
  const char* shows;
  // Components that the image consists of; the others are left out.
  bool direct_light;  ///< and all other light that camera paths add without photons
  bool caustic_map, global_map;

  /// Passes are then those of the whole image, with more samples where these disagree.
  bool made_from_all() const { return direct_light && caustic_map && global_map; }
  /// Shows a number of the whole render, in place of light.
  bool is_number() const { return made_from_all() && view != Aov::whole; }
};

/// One row per view, in the order of the enumeration.
const std::vector<AovRow>& aov_table();
inline const AovRow& aov_row(Aov view) { return aov_table()[static_cast<std::size_t>(view)]; }
/// Throws InputError listing the valid names.
Aov aov_named(const std::string& name);

}  // namespace photonproof::inline renderer_passes
