#include "renderer/integrators/check_supported.h"

#include <algorithm>

#include "scenes/description/emitter_kinds.h"

namespace photonproof::inline renderer_integrators {
namespace {

const Integrator& row_of(const SceneDescription* description, const IntegratorDescription& method) {
  const std::string name = integrator_name(method);
  if (const Integrator* row = find_integrator(name)) return *row;
  throw InputError(description != nullptr ? description->where(method.loc) : "--integrator",
                   "this program has no integrator '" + name + "'");
}

std::vector<bool> media_in_use(const SceneDescription& description) {
  std::vector<bool> used(description.media.size(), false);
  const auto use = [&](const std::optional<MediumIndex>& medium) {
    if (medium) used.at(medium->value) = true;
  };
  const auto use_both_sides = [&](const ShapeDescription& shape) {
    use(shape.interior);
    use(shape.exterior);
  };
  for (const ShapeDescription& shape : description.shapes) use_both_sides(shape);
  for (const ShapeGroupDescription& group : description.groups)
    for (const ShapeDescription& shape : group.shapes) use_both_sides(shape);
  use(description.sensor.medium);
  return used;
}

bool scatters(const MediumDescription& medium) {
  return std::visit([](const auto& m) { return max_component(m.albedo) > 0; }, medium.model);
}

/// Whether mirrors or glass may reflect or refract light that no camera path finds.
bool may_throw_light_of_points(const SceneDescription& description) {
  return std::ranges::any_of(description.emitters, is_without_size) &&
         std::ranges::any_of(description.bsdfs,
                             [](const BsdfDescription& bsdf) -> bool { return traits_of(bsdf).specular; });
}

/// Names integrators that support absorbing media and dielectric priorities, and those that support scattering media.
std::string advice(const SceneDescription& description, bool any_scatters) {
  if (!may_throw_light_of_points(description)) return "use 'volpath'";
  return any_scatters
             ? "'volpath' does, without the light of lights without size that mirrors, glass or clear coats send "
               "on: no integrator of this program finds that in such media"
             : "use 'bdpt'";
}

void check_media(const SceneDescription& description, const Integrator& row) {
  const std::vector<bool> used = media_in_use(description);
  bool any_scatters = false;
  for (std::size_t i = 0; i < used.size(); ++i)
    any_scatters = any_scatters || (used[i] && scatters(description.media[i]));
  for (std::size_t i = 0; i < used.size(); ++i) {
    const MediumDescription& medium = description.media[i];
    if (!used[i] || row.media == Integrator::Media::all) continue;
    if (row.media == Integrator::Media::absorbing && !scatters(medium)) continue;
    const std::string cannot =
        row.media == Integrator::Media::none ? "does not do media" : "does not do media that scatter";
    throw InputError(description.where(medium.loc),
                     "integrator '" + std::string(row.name) + "' " + cannot + ": " + advice(description, any_scatters));
  }
}

void check_priorities(const SceneDescription& description, const Integrator& row) {
  if (row.dielectric_priorities) return;
  for (const BsdfDescription& bsdf : description.bsdfs) {
    const auto* glass = std::get_if<DielectricDescription>(&bsdf.model);
    if (glass != nullptr && glass->priority)
      throw InputError(description.where(bsdf.loc),
                       "integrator '" + std::string(row.name) +
                           "' does not do priorities of dielectrics: " + advice(description, false));
  }
}

void check_direct(const SceneDescription& description, const IntegratorDescription& method) {
  const auto* direct = std::get_if<DirectDescription>(&method.method);
  if (direct == nullptr) return;
  if (direct->emitter_samples < 0 || direct->bsdf_samples < 0 || direct->emitter_samples + direct->bsdf_samples == 0)
    throw InputError(description.where(method.loc),
                     "emitter_samples and bsdf_samples must not be negative, nor both 0");
}

}  // namespace

void check_supported(const SceneDescription& description, const IntegratorDescription& method) {
  const Integrator& row = row_of(&description, method);
  check_media(description, row);
  check_priorities(description, row);
  check_direct(description, method);
}

void check_job(const RenderJob& job, const IntegratorDescription& method) {
  const Integrator& row = row_of(nullptr, method);
  const auto refuse = [&](const char* option, const char* why) {
    throw InputError(option, "does nothing with integrator '" + std::string(row.name) + "', which " + why);
  };
  if (job.budget.photons && !row.heeds.photons) refuse("--photons", "stores no photons");
  if (job.budget.photons && job.budget.seconds)
    throw InputError("--photons", "does nothing with --seconds, which decides how many there are");
  if (job.view == Aov::cache_records && row.heeds.view &&
      !std::holds_alternative<PhotonMapperDescription>(method.method))
    refuse("--view cache-records", "has no irradiance cache");
  if (job.budget.target_error && !row.heeds.target_error)
    throw InputError("--target-error", "integrator '" + std::string(row.name) +
                                           "' cannot tell its own error: give it another budget and compare its image");
  if (job.grid > 0 && !row.heeds.grid) refuse("--grid", "does not choose where in a pixel its samples are");
  if (job.view != Aov::whole && !row.heeds.view) refuse("--view", "makes no photon maps");
  if (job.grid > 0 && job.view == Aov::photons)
    throw InputError("--grid", "does nothing with --view photons, which takes no camera samples");
  if (!job.isa.empty() && !row.heeds.isa) refuse("--isa", "has no kernels");
}

}  // namespace photonproof::inline renderer_integrators
