#include "renderer/api/direct_as_mitsuba.h"

#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_api {
namespace {

/// Mitsuba adds the samples of a light without size instead of taking their mean.
void brighten_lights_without_size(SceneDescription& scene, int samples) {
  for (EmitterDescription& emitter : scene.emitters) {
    const bool changed = std::visit(Overloaded{[&](PointLightDescription& d) {
                                                 d.intensity *= samples;
                                                 return true;
                                               },
                                               [&](SpotLightDescription& d) {
                                                 d.intensity *= samples;
                                                 return true;
                                               },
                                               [&](DirectionalLightDescription& d) {
                                                 d.irradiance *= samples;
                                                 return true;
                                               },
                                               [&](ProjectorDescription& d) {
                                                 d.scale *= samples;
                                                 return true;
                                               },
                                               [](auto&) { return false; }},
                                    emitter.light);
    if (changed)
      scene.notes.push_back({scene.where(emitter.loc), "as in Mitsuba, 'direct' shows this light " +
                                                           std::to_string(samples) + " times as bright, for its " +
                                                           std::to_string(samples) + " samples of lights"});
  }
}

/// Without samples of directions, Mitsuba shows no mirrored and no transmitted light.
void blacken_mirrors(SceneDescription& scene) {
  const BsdfIndex black{static_cast<std::uint32_t>(scene.bsdfs.size())};
  const DiffuseDescription no_light{.reflectance = RgbD(0.0)};
  for (BsdfDescription& bsdf : scene.bsdfs) {
    const bool is_mirror = std::holds_alternative<ConductorDescription>(bsdf.model) ||
                           std::holds_alternative<DielectricDescription>(bsdf.model) ||
                           std::holds_alternative<ThinDielectricDescription>(bsdf.model) ||
                           std::holds_alternative<NullDescription>(bsdf.model);
    const auto* mask = std::get_if<MaskDescription>(&bsdf.model);
    auto* plastic = std::get_if<PlasticDescription>(&bsdf.model);
    if (!is_mirror && mask == nullptr && plastic == nullptr) continue;
    if (plastic != nullptr) plastic->specular_reflectance = RgbD(0.0);
    if (mask != nullptr) bsdf.model = BlendDescription{.weight = mask->opacity, .first = black, .second = mask->nested};
    if (is_mirror) bsdf.model = no_light;
    scene.notes.push_back({scene.where(bsdf.loc),
                           "as in Mitsuba, 'direct' without samples of directions shows nothing "
                           "mirrored and nothing behind this"});
  }
  scene.bsdfs.push_back({{}, "", no_light});
}

}  // namespace

std::optional<SceneDescription> direct_as_mitsuba(const SceneDescription& scene, const IntegratorDescription& method) {
  const auto* direct = std::get_if<DirectDescription>(&method.method);
  if (!scene.as_mitsuba || direct == nullptr || (direct->emitter_samples <= 1 && direct->bsdf_samples > 0))
    return std::nullopt;
  SceneDescription changed = scene;
  if (direct->emitter_samples > 1) brighten_lights_without_size(changed, direct->emitter_samples);
  if (direct->bsdf_samples == 0) blacken_mirrors(changed);
  return changed;
}

}  // namespace photonproof::inline renderer_api
