// What of a photon mapper's render the image shows: all its light, or for teaching, a part of it, or how it was made.
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
  // What it is made from; the rest is left out:
  bool direct_light;  ///< and all else that camera paths bring without photons
  bool caustic_map, global_map;

  /// Then passes are those of the whole image, with more samples where these disagree.
  bool made_from_all() const { return direct_light && caustic_map && global_map; }
  /// A number of the whole render at work, in place of light.
  bool is_number() const { return made_from_all() && view != Aov::whole; }
};

/// One row a view, in the order of the enumeration.
const std::vector<AovRow>& aov_table();
inline const AovRow& aov_row(Aov view) { return aov_table()[static_cast<std::size_t>(view)]; }
/// Throws InputError naming the known ones.
Aov aov_named(const std::string& name);

}  // namespace photonproof::inline renderer_passes
