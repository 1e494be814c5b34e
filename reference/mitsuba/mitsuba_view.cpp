// Camera, film and integrator for Mitsuba.
#include <algorithm>
#include <type_traits>
#include <variant>

#include "reference/mitsuba/mitsuba_lowering.h"
#include "scenes/description/emitter_kinds.h"

namespace photonproof::inline reference_mitsuba {
namespace {

void lower_film(MitsubaLowering& lowering) {
  const SensorDescription& sensor = lowering.scene().sensor;
  FilmDescription& film = lowering.lowered().sensor.film;
  if (film.crop)
    lowering.explain("the whole film, of which the crop is kept: Mitsuba's filter ends at a crop's border");
  film.crop.reset();
  film.alpha = false;
  using Kind = ReconstructionFilter::Kind;
  if (film.filter.kind == Kind::tent && film.filter.radius <= 0.5)
    lowering.refuse(sensor.loc, "a tent of a radius of half a pixel or less: Mitsuba filters by a box");
  if (film.filter.kind == Kind::sinc) lowering.refuse(sensor.loc, "a sinc filter: Mitsuba has none; a lanczos works");
  if (film.filter.kind == Kind::mitchell && film.filter.mitchell_radius && *film.filter.mitchell_radius != 2)
    lowering.refuse(sensor.loc, "a mitchell filter of another radius than 2: Mitsuba's has none");
  film.filter.mitchell_radius.reset();
}

void lower_camera(MitsubaLowering& lowering) {
  const SensorDescription& sensor = lowering.scene().sensor;
  if (std::holds_alternative<FisheyeDescription>(sensor.camera)) {
    lowering.explain("fisheye of " + lowering.scene().where(sensor.loc) + ": our plugin, as Mitsuba 3 has none");
    return lowering.need("fisheye");
  }
  if (const auto* lens = std::get_if<ThinLensDescription>(&sensor.camera))
    if (lens->perspective.principal_x != 0 || lens->perspective.principal_y != 0)
      lowering.refuse(sensor.loc, "a principal point beside the middle of a thin lens: Mitsuba's has none");
  if (!std::holds_alternative<PerspectiveDescription>(sensor.camera) &&
      !std::holds_alternative<ThinLensDescription>(sensor.camera) &&
      !std::holds_alternative<OrthographicDescription>(sensor.camera))
    lowering.refuse(sensor.loc, "a meter or a batch of cameras: not written yet");
}

/// Whether the volumetric path tracer is needed. Mitsuba's `path` takes holes of masks for solid where it samples
/// lights, and shows surfaces behind a hidden light without sampled light.
bool needs_volpath(const SceneDescription& scene) {
  const auto has_holes = [](const BsdfDescription& bsdf) {
    return std::holds_alternative<MaskDescription>(bsdf.model) || std::holds_alternative<NullDescription>(bsdf.model);
  };
  return !scene.media.empty() || scene.integrator.limits().hide_emitters ||
         std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(), has_holes);
}

void lower_integrator(MitsubaLowering& lowering) {
  const SceneDescription& scene = lowering.scene();
  const IntegratorDescription& given = scene.integrator;
  if (std::holds_alternative<RadianceFieldDescription>(given.method))
    lowering.refuse(given.loc, "a radiance field: not written yet");
  PathLimits limits = given.limits();
  const bool is_path = std::holds_alternative<PathDescription>(given.method);
  const bool is_volpath = std::holds_alternative<VolPathDescription>(given.method);
  auto& method = lowering.lowered().integrator.method;
  if (needs_volpath(scene)) {
    if (!is_volpath)
      lowering.explain("integrator volpath: the scene has media, holes, or lights that the camera does not see");
    method = VolPathDescription{limits};
  } else {
    if (!is_path) lowering.explain("integrator path with the same limits, in place of the scene's own");
    method = PathDescription{limits};
  }
}

struct Surfaces {
  bool clear = false, wide = false;
};

/// Adds what the BSDF does to light: turns some into one direction, or spreads it.
void look_at(const SceneDescription& scene, BsdfIndex index, Surfaces& seen) {
  const BsdfDescription& bsdf = scene.bsdfs[index.value];
  const std::vector<BsdfIndex> nested = nested_bsdfs(bsdf);
  const BsdfTraits traits = traits_of(bsdf);
  const bool coat =
      std::holds_alternative<PlasticDescription>(bsdf.model) || std::holds_alternative<LayeredDescription>(bsdf.model);
  if (traits.specular) seen.clear = true;
  if (!traits.specular || coat) seen.wide |= nested.empty() && !std::holds_alternative<NullDescription>(bsdf.model);
  for (const BsdfIndex inner : nested) look_at(scene, inner, seen);
}

/// Mitsuba's path tracers start at the camera. They never find light of a light without size that mirrors or glass cast
/// onto rough surfaces or into fog.
void check_caustics(const MitsubaLowering& lowering) {
  const SceneDescription& scene = lowering.scene();
  Surfaces seen;
  seen.wide = !scene.media.empty();
  const auto look = [&](const std::vector<ShapeDescription>& shapes) {
    for (const ShapeDescription& shape : shapes)
      if (!std::holds_alternative<InstanceDescription>(shape.geometry)) look_at(scene, shape.bsdf, seen);
  };
  look(scene.shapes);
  for (const ShapeGroupDescription& group : scene.groups) look(group.shapes);
  if (!seen.clear || !seen.wide) return;
  for (const EmitterDescription& emitter : scene.emitters)
    if (is_without_size(emitter))
      lowering.refuse(emitter.loc,
                      "a light without size beside mirrors or glass: its caustics can be sampled from the light only, "
                      "and Mitsuba's paths start at the camera");
}

}  // namespace

void lower_view(MitsubaLowering& lowering) {
  lower_film(lowering);
  lower_camera(lowering);
  lower_integrator(lowering);
  check_caustics(lowering);
}

}  // namespace photonproof::inline reference_mitsuba
