#include "renderer/media/medium.h"

#include "renderer/core/ray.h"
#include "scenes/base/faults.h"

namespace photonproof::inline renderer_media {
namespace {

Medium compile(const HomogeneousDescription& d) {
  Medium medium;
  medium.sigma_t = Rgb(d.sigma_t * (has_fault(Fault::thin_medium) ? 0.9 * d.scale : d.scale));
  medium.albedo = Rgb(d.albedo);
  if (const auto* phase = std::get_if<HenyeyGreensteinDescription>(&d.phase))
    medium.phase.g = static_cast<float>(has_fault(Fault::backward_phase) ? -phase->g : phase->g);
  medium.scatters = max_component(medium.sigma_t * medium.albedo) > 0;
  return medium;
}

}  // namespace

FreeFlight fly(const Medium& medium, const Rgb& throughput, float distance, float u_channel, float u_distance) {
  const float sum = throughput.x + throughput.y + throughput.z;
  const Rgb chance = throughput / sum;
  const float pick = u_channel * sum;
  const float extinction = pick < throughput.x                  ? medium.sigma_t.x
                           : pick < throughput.x + throughput.y ? medium.sigma_t.y
                                                                : medium.sigma_t.z;
  const float t = extinction > 0 ? -std::log1p(-u_distance) / extinction : distance;
  if (t >= distance) {
    const Rgb left = medium.transmittance(distance);
    return {std::nullopt, left / dot(chance, left)};
  }
  const Rgb scattering = medium.transmittance(t) * medium.sigma_t;
  return {t, scattering * medium.albedo / dot(chance, scattering)};
}

SceneMedia compile_media(const SceneDescription& description) {
  SceneMedia media;
  for (const MediumDescription& m : description.media)
    media.media.push_back(std::visit([](const auto& model) { return compile(model); }, m.model));
  for (const BsdfDescription& b : description.bsdfs) {
    InteriorDescription interior;
    if (const auto* glass = std::get_if<DielectricDescription>(&b.model))
      interior = {glass->priority, static_cast<float>(glass->int_ior), static_cast<float>(glass->ext_ior)};
    media.any_priority = media.any_priority || interior.priority.has_value();
    media.interiors.push_back(interior);
  }
  media.interiors.emplace_back();  // where a mask has holes
  media.around_camera = description.sensor.medium ? description.sensor.medium->value : no_index;
  return media;
}

}  // namespace photonproof::inline renderer_media
