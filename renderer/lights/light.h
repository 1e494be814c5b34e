// Every kind of light, as the host sees it: those of light_kinds.h, which kernels also sample in their lanes, and those
// that need tables, which offer the same as classes. Code that does not care which it has asks scene_lights.h.
#pragma once

#include "renderer/lights/light_area.h"
#include "renderer/lights/light_environment.h"
#include "renderer/lights/light_ies.h"
#include "renderer/lights/light_kinds.h"
#include "renderer/lights/light_textured_spot.h"

namespace photonproof {

using Light = std::variant<QuadLight<float>, SphereLight<float>, PointLight<float>, DiskLight<float>, SpotLight<float>,
                           DirectionalLight<float>, AreaLight, EnvironmentLight, IesLight, TexturedSpotLight>;
static_assert(std::is_same_v<std::variant_alternative_t<LightKinds::count, Light>, AreaLight>,
              "a light's index is its kind in the kernels' tables");

/// What LightWords::kind says.
inline std::uint32_t kernel_kind(const Light& light) {
  return std::min(static_cast<std::uint32_t>(light.index()), general_light_kind);
}
/// A delta light cannot be found by a ray.
inline bool is_delta(const Light& light) {
  return std::visit([](const auto& l) { return l.is_delta; }, light);
}
inline bool is_infinite(const Light& light) {
  return std::visit([](const auto& l) { return l.is_infinite; }, light);
}
inline Rgb flux(const Light& light) {
  return std::visit([](const auto& l) { return l.flux(); }, light);
}

}  // namespace photonproof
