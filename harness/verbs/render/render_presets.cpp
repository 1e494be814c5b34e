#include "harness/verbs/render/render_presets.h"

#include <algorithm>
#include <variant>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_verbs_render {
namespace {

bool lets_light_through(const SceneDescription& scene, BsdfIndex index) {
  const BsdfDescription& bsdf = scene.bsdfs.at(index.value);
  if (traits_of(bsdf).transmits) return true;
  return std::ranges::any_of(nested_bsdfs(bsdf), [&](BsdfIndex nested) { return lets_light_through(scene, nested); });
}

bool has_water(const SceneDescription& scene) {
  const auto is_water = [&](const ShapeDescription& shape) {
    return std::holds_alternative<HeightfieldDescription>(shape.geometry) && lets_light_through(scene, shape.bsdf);
  };
  return std::ranges::any_of(scene.shapes, is_water) || std::ranges::any_of(scene.groups, [&](const auto& group) {
           return std::ranges::any_of(group.shapes, is_water);
         });
}

/// A performance-engineering course's photon mapper, as far as ours has the same. docs/formats/scene.md lists the
/// differences.
std::string apply_course(SceneDescription& scene, bool size_is_asked_for) {
  constexpr int pixels = 600, shadow_rays = 6 * 6, depth = 6;
  const bool water = has_water(scene);
  PhotonMapperDescription settings;
  settings.max_depth = 2 * depth;
  settings.hide_emitters = scene.integrator.limits().hide_emitters;
  settings.indirect = IndirectLight::cache;
  settings.gather_rays = 28 * 13;
  settings.global_photons = 1000;
  settings.caustic_photons = water ? 2'000'000 : 10'000;
  settings.global_radius = 30;
  settings.caustic_radius = 4;
  scene.integrator.method = settings;
  scene.sensor.sample_count = shadow_rays;
  if (!size_is_asked_for) scene.sensor.film.resize(pixels, pixels);
  return std::string(
             "course: photonmapper with an irradiance cache of 28 x 13 rays, 1000 global photons within 30 and ") +
         (water ? "2000000 (there is water)" : "10000") +
         " caustic photons within 4 scene units, paths of 12 edges at most, 36 samples in the middle of every pixel, "
         "each "
         "with a shadow ray";
}

}  // namespace

const std::vector<RenderPreset>& render_presets() {
  static const std::vector<RenderPreset> presets{
      {"course", "course: photonmapper at 600x600, as the course assigns it", 1, apply_course}};
  return presets;
}

const RenderPreset* preset_named(const std::string& name) {
  if (name.empty()) return nullptr;
  for (const RenderPreset& preset : render_presets())
    if (name == preset.name) return &preset;
  throw InputError("--preset", "there is no preset '" + name + "'");
}

}  // namespace photonproof::inline harness_verbs_render
