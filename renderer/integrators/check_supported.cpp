#include "renderer/integrators/check_supported.h"

#include <algorithm>

#include "scenes/base/text_numbers.h"
#include "scenes/description/emitter_kinds.h"
#include "scenes/description/sensors.h"

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
  return std::visit([](const auto& model) { return max_component(most(model.albedo)) > 0; }, medium.model);
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
  return any_scatters ? "'volpath' does, but misses caustics of lights without size: no integrator of this program "
                        "finds them in such media"
                      : "use 'bdpt'";
}

/// Mean free paths across a medium that varies, at its largest extinction and along the diagonal of its box.
double most_free_paths(const MediumDescription& medium) {
  const auto& cloud = std::get<HeterogeneousDescription>(medium.model);
  Vec3d edges(1.0);
  const Transform to_world = place_of(cloud.sigma_t);
  const auto* grid = std::get_if<GridVolumeDescription>(&cloud.sigma_t);
  if (grid != nullptr && grid->use_grid_bbox) edges = Vec3d(grid->grid->high) - Vec3d(grid->grid->low);
  double diagonal = 0;
  for (const Vec3d& edge : {Vec3d{edges.x, 0, 0}, {0, edges.y, 0}, {0, 0, edges.z}})
    diagonal += length(to_world.vector(edge));
  return max_component(bounds_of(medium).extinction) * diagonal;
}

/// Beyond, a path takes too many collisions to end.
constexpr double limit_of_free_paths = 1e6;

void check_density(const SceneDescription& description, const MediumDescription& medium) {
  if (!medium.varies()) return;
  const double paths = most_free_paths(medium);
  if (!(paths <= limit_of_free_paths))
    throw InputError(description.where(medium.loc), "the medium is up to " + format_number(paths) +
                                                        " mean free paths across, expected at most 1e6: light would "
                                                        "collide too often to be followed");
}

void check_media(const SceneDescription& description, const Integrator& row) {
  const std::vector<bool> used = media_in_use(description);
  bool any_scatters = false;
  for (std::size_t i = 0; i < used.size(); ++i)
    any_scatters = any_scatters || (used[i] && (scatters(description.media[i]) || description.media[i].varies()));
  for (std::size_t i = 0; i < used.size(); ++i) {
    const MediumDescription& medium = description.media[i];
    if (!used[i]) continue;
    if (row.media == Integrator::Media::all) {
      check_density(description, medium);
      continue;
    }
    if (row.media == Integrator::Media::absorbing && !scatters(medium) && !medium.varies()) continue;
    const std::string cannot = row.media == Integrator::Media::none ? "does not do media"
                               : medium.varies()                    ? "does not do media that vary"
                                                                    : "does not do media that scatter";
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

void check_radiance_field(const SceneDescription& description, const IntegratorDescription& method) {
  if (!std::holds_alternative<RadianceFieldDescription>(method.method)) return;
  const auto check = [&](const ShapeDescription& shape) {
    const auto* ellipsoids = std::get_if<EllipsoidsDescription>(&shape.geometry);
    if (ellipsoids != nullptr && !ellipsoids->cloud->is_radiance_field())
      throw InputError(description.where(shape.loc),
                       "integrator 'volprim_rf_basic' needs opacities and spherical "
                       "harmonics, which '" +
                           ellipsoids->filename + "' lacks");
  };
  std::ranges::for_each(description.shapes, check);
  for (const ShapeGroupDescription& group : description.groups) std::ranges::for_each(group.shapes, check);
}

bool is_single_camera(const SensorDescription& sensor) {
  return !is_meter(sensor) && !std::holds_alternative<BatchDescription>(sensor.camera);
}

void check_sensor(const SceneDescription& description, const Integrator& row) {
  const SensorDescription& sensor = description.sensor;
  if (is_single_camera(sensor)) return;
  if (row.connects_to_camera)
    throw InputError(description.where(sensor.loc), "integrator '" + std::string(row.name) +
                                                        "' does not do sensors other than single cameras: use 'path'");
  const bool has_priority = std::ranges::any_of(description.bsdfs, [](const BsdfDescription& bsdf) {
    const auto* glass = std::get_if<DielectricDescription>(&bsdf.model);
    return glass != nullptr && glass->priority;
  });
  if (std::holds_alternative<BatchDescription>(sensor.camera) &&
      (has_priority || std::ranges::count(media_in_use(description), true) > 0))
    throw InputError(description.where(sensor.loc),
                     "a batch cannot be in a scene with media or priorities of dielectrics, as its cameras may be in "
                     "different ones: render them one by one");
}

}  // namespace

void check_supported(const SceneDescription& description, const IntegratorDescription& method) {
  const Integrator& row = row_of(&description, method);
  check_media(description, row);
  check_priorities(description, row);
  check_sensor(description, row);
  check_direct(description, method);
  check_radiance_field(description, method);
}

void check_view(const SceneDescription& description, const RenderJob& job) {
  if (job.view == Aov::photons && !is_single_camera(description.sensor))
    throw InputError("--view photons", "needs a single camera, to which photons are connected");
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
    throw InputError("--target-error",
                     "integrator '" + std::string(row.name) +
                         "' cannot estimate its own error: give it another budget and compare its image");
  if (job.grid > 0 && !row.heeds.grid) refuse("--grid", "does not choose where in a pixel its samples are");
  if (job.view != Aov::whole && !row.heeds.view) refuse("--view", "makes no photon maps");
  if (job.grid > 0 && job.view == Aov::photons)
    throw InputError("--grid", "does nothing with --view photons, which takes no camera samples");
  if (!job.isa.empty() && !row.heeds.isa) refuse("--isa", "has no kernels");
}

}  // namespace photonproof::inline renderer_integrators
