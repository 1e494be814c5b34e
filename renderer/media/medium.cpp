#include "renderer/media/medium.h"

#include <type_traits>

#include "renderer/core/ray.h"
#include "renderer/media/varying_medium.h"
#include "scenes/base/faults.h"

namespace photonproof::inline renderer_media {
namespace {

struct CompileLobe {
  PhaseFunction::Lobe operator()(const IsotropicDescription&) const { return HenyeyGreenstein{}; }
  PhaseFunction::Lobe operator()(const RayleighDescription&) const { return Rayleigh{}; }
  PhaseFunction::Lobe operator()(const HenyeyGreensteinDescription& d) const {
    return HenyeyGreenstein{static_cast<float>(has_fault(Fault::backward_phase) ? -d.g : d.g)};
  }
};

PhaseFunction compile_phase(const PhaseDescription& d) {
  return std::visit(
      []<class Phase>(const Phase& phase) -> PhaseFunction {
        if constexpr (std::is_same_v<Phase, BlendPhaseDescription>) {
          const double* weight = std::get_if<double>(&phase.weight);
          return {std::visit(CompileLobe(), phase.first), std::visit(CompileLobe(), phase.second),
                  weight != nullptr ? static_cast<float>(*weight) : 0};
        } else
          return {CompileLobe()(phase), {}, 0};
      },
      d);
}

double with_fault(double scale) { return has_fault(Fault::thin_medium) ? 0.9 * scale : scale; }

void compile_phase(const PhaseDescription& d, const VolumeFrame& frame, Medium& medium) {
  medium.phase = compile_phase(d);
  if (const auto* blend = std::get_if<BlendPhaseDescription>(&d))
    if (const auto* weights = std::get_if<GridVolumeDescription>(&blend->weight))
      medium.second_lobe_map = std::make_shared<const Volume>(*weights, frame);
}

Medium compile(const HomogeneousDescription& d, const VolumeFrame& frame) {
  Medium medium;
  medium.sigma_t = Rgb(d.sigma_t * with_fault(d.scale));
  if (const RgbD* constant = constant_of(d.albedo)) {
    medium.albedo = Rgb(*constant);
  } else {
    medium.albedo = Rgb(1.0f);
    medium.albedo_map = std::make_shared<const Volume>(d.albedo, frame);
  }
  compile_phase(d.phase, frame, medium);
  medium.scatters = max_component(medium.sigma_t * Rgb(most(d.albedo))) > 0;
  return medium;
}

Medium compile(const HeterogeneousDescription& d, const VolumeFrame& frame) {
  Medium medium;
  compile_phase(d.phase, frame, medium);
  medium.varying = std::make_shared<const VaryingMedium>(d, frame, with_fault(1));
  medium.scatters = medium.varying->scatters();
  return medium;
}

}  // namespace

PhaseFunction Medium::phase_at(const Vec3f& p) const {
  PhaseFunction there = phase;
  if (second_lobe_map) there.weight = second_lobe_map->at(p).x;
  return there;
}

FreeFlight fly(const Medium& medium, const Rgb& throughput, const Vec3f& origin, const Vec3f& direction, float distance,
               float u_channel, float u_distance) {
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
  const Rgb albedo = medium.albedo_map ? medium.albedo_map->at(origin + direction * t) : medium.albedo;
  return {t, scattering * albedo / dot(chance, scattering)};
}

SceneMedia compile_media(const SceneDescription& description, const VolumeFrame& frame) {
  SceneMedia media;
  for (const MediumDescription& m : description.media)
    media.media.push_back(std::visit([&](const auto& model) { return compile(model, frame); }, m.model));
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
