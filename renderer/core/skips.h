// Work that a render may skip because the scene does not need it, and switches that force it. The switches do not
// change the image, or only its noise: each has a test of this (skips_test.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace photonproof::inline renderer_core {

enum class Skip : std::uint32_t {
  bvh,
  mis,
  light_sampling,
  far_lights,
  direct_light,
  bsdf_groups,
  shadow_rays,
  global_map,
  caustic_map,
  stray_photons,
  camera_pilot,
  surface_detail
};

struct SkipRow {
  Skip skip;
  const char* name;
  const char* what;  ///< the skipped work
};

/// One row per skip, in the order of the enumeration.
const std::vector<SkipRow>& skip_table();
inline const SkipRow& skip_row(Skip skip) { return skip_table()[static_cast<std::size_t>(skip)]; }

/// Every skip is on unless it was switched off.
class SkipSwitches {
 public:
  SkipSwitches() = default;
  /// `names` are of the table, or "all". Throws InputError listing the valid ones.
  explicit SkipSwitches(const std::vector<std::string>& names_switched_off);

  bool on(Skip skip) const { return (off_ >> static_cast<std::uint32_t>(skip) & 1u) == 0; }
  void switch_off(Skip skip) { off_ |= 1u << static_cast<std::uint32_t>(skip); }

 private:
  std::uint32_t off_ = 0;
};

}  // namespace photonproof::inline renderer_core
