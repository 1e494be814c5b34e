// What a render may leave out because the scene does not need it, and the switches that make it do so all the same. The
// image does not depend on them, or only its noise: each has a test that says so (skips_test.cpp).
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
  const char* what;  ///< is left out
};

/// One row a skip, in the order of the enumeration.
const std::vector<SkipRow>& skip_table();
inline const SkipRow& skip_row(Skip skip) { return skip_table()[static_cast<std::size_t>(skip)]; }

/// Every skip is on unless it was switched off.
class SkipSwitches {
 public:
  SkipSwitches() = default;
  /// `names` are of the table, or "all". Throws InputError naming the known ones.
  explicit SkipSwitches(const std::vector<std::string>& names_switched_off);

  bool on(Skip skip) const { return (off_ >> static_cast<std::uint32_t>(skip) & 1u) == 0; }
  void switch_off(Skip skip) { off_ |= 1u << static_cast<std::uint32_t>(skip); }

 private:
  std::uint32_t off_ = 0;
};

}  // namespace photonproof::inline renderer_core
