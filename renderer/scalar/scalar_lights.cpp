#include "renderer/scalar/scalar_lights.h"

namespace photonproof::inline renderer_scalar {

ScalarLights::ScalarLights(const SceneInterface& scene)
    : scene_interface_(scene), lights_(scene.scene().scene_lights()), surface_(scene.scene().lights.size(), no_index) {
  const std::vector<Surface>& surfaces = scene.scene().surfaces;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].light != no_index) surface_[surfaces[i].light] = i;
}

SegmentEnd ScalarLights::end(std::uint32_t light, const LightPoint<float>& at) const {
  const std::uint32_t first = scene_interface_.view().light_words[light].primitive;
  return {at.p, at.normal, first == no_index ? no_index : first + at.triangle, surface_[light],
          lights_.is_outside(light)};
}

LightPoint<float> ScalarLights::point(const Interaction& met) const {
  const std::uint32_t first =
      scene_interface_.view().small ? scene_interface_.view().light_words[met.light].primitive : 0;
  return lights_.with_uv(met.light, {met.p, met.ng, {}, met.primitive - first});
}

}  // namespace photonproof::inline renderer_scalar
