#include "renderer/core/skips.h"

#include "scenes/base/input_error.h"

namespace photonproof::inline renderer_core {

const std::vector<SkipRow>& skip_table() {
  static const std::vector<SkipRow> table{
      {Skip::bvh, "bvh", "Embree and its hierarchy"},
      {Skip::mis, "mis", "weights against lights that rays meet by themselves"},
      {Skip::light_sampling, "light-choice", "the random choice among lights"},
      {Skip::far_lights, "far-lights", "choosing lights that give a point little as often as others"},
      {Skip::direct_light, "direct-light", "direct light"},
      {Skip::bsdf_groups, "bsdf-groups", "sorting lanes by the kind of their BSDF"},
      {Skip::shadow_rays, "shadow-rays", "shadow rays to lights that a cosine of 0 hides"},
      {Skip::global_map, "global-map", "the global photon map"},
      {Skip::caustic_map, "caustic-map", "the caustic photon map"},
      {Skip::stray_photons, "stray-photons", "caustic photons that set out towards nothing specular"},
      {Skip::camera_pilot, "camera-pilot", "samples beforehand that find where lights are rarely seen"},
      {Skip::surface_detail, "surface-detail", "texture coordinates, shading normals and nested BSDFs of every hit"},
  };
  return table;
}

SkipSwitches::SkipSwitches(const std::vector<std::string>& names_switched_off) {
  for (const std::string& name : names_switched_off) {
    bool known = false;
    std::string names;
    for (const SkipRow& row : skip_table()) {
      names += row.name;
      names += ", ";
      if (name != row.name && name != "all") continue;
      switch_off(row.skip);
      known = true;
    }
    if (known) continue;
    std::string problem = "there is no skip '";
    problem += name;
    problem += "', expected one of ";
    problem += names;
    problem += "all";
    throw InputError("--no-skip", problem);
  }
}

}  // namespace photonproof::inline renderer_core
