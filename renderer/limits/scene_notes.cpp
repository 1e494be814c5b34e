#include "renderer/limits/scene_notes.h"

#include <algorithm>
#include <set>

#include "renderer/bsdfs/bsdf_phong.h"
#include "renderer/bsdfs/microfacet.h"
#include "renderer/lights/sky_sun.h"
#include "renderer/limits/precision_notes.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline renderer_limits {
namespace {

struct BsdfNotes {
  Notes& notes;
  const SourceLoc& loc;

  void operator()(const PhongDescription& d) const {
    notes.limit(loc, "exponent", d.exponent, [](float n) { return PhongBsdf<float>{n, {}, {}}.exponent(); });
    shares(d);
  }
  template <class Other>
  void operator()(const Other& d) const {
    static_assert(
        !requires { d.exponent; }, "each BSDF says which exponents are usable");
    if constexpr (requires { d.shares(); }) shares(d);
    if constexpr (requires { d.alpha_u; })
      roughness(d.alpha_u, d.alpha_v);
    else if constexpr (requires { d.alpha; })
      roughness(d.alpha, d.alpha);
  }

 private:
  template <class Description>
  void shares(const Description& d) const {
    const auto [first, second] = d.shares();
    const auto *a = std::get_if<RgbD>(&first.second), *b = std::get_if<RgbD>(&second.second);
    if (a == nullptr || b == nullptr) return;
    const auto sum = static_cast<float>(max_component(*a + *b));
    if (sum > 1)
      notes.add(loc, std::string(first.first) + " and " + second.first + " add up to " +
                         format_number(static_cast<double>(sum)) + " in a channel: both are rendered divided by that");
  }
  void roughness(const Scalar& along_u, const Scalar& along_v) const {
    const auto usable = Microfacets<float>::usable;
    notes.limit(loc, along_u == along_v ? "alpha" : "alpha_u", along_u, usable);
    if (along_u != along_v) notes.limit(loc, "alpha_v", along_v, usable);
  }
};

std::size_t triangles_without_area(const TriangleMesh& mesh) {
  return static_cast<std::size_t>(std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                                                [&](const auto& t) { return !has_area(mesh.positions, t); }));
}

void add_mesh_notes(const SceneDescription& description, Notes& notes) {
  std::set<const TriangleMesh*> known;  // one note for a file that several shapes share
  const auto look_at = [&](const ShapeDescription& shape) {
    const auto* file = std::get_if<MeshDescription>(&shape.geometry);
    if (file == nullptr || !known.insert(file->mesh.get()).second) return;
    const std::size_t flat = triangles_without_area(*file->mesh), all = file->mesh->triangles.size();
    if (flat == 0) return;
    notes.add(shape.loc, std::to_string(flat) + " of the " + std::to_string(all) + " triangles of '" + file->filename +
                             "' " + (flat == 1 ? "has" : "have") + " no area and cannot be seen");
  };
  for (const ShapeDescription& shape : description.shapes) look_at(shape);
  for (const ShapeGroupDescription& group : description.groups)
    for (const ShapeDescription& shape : group.shapes) look_at(shape);
}

bool is_zero(const RgbD& colour) { return colour == RgbD(0.0); }

/// The reason why a light has no light in it.
struct Darkness {
  std::string operator()(const IesLightDescription& d) const { return "every candela of '" + d.filename + "' is 0"; }
  std::string operator()(const EnvmapDescription& d) const { return "every pixel of '" + d.filename + "' is 0"; }
  std::string operator()(const SunSkyDescription&) const { return "the sun is below the horizon"; }
  template <class Other>
  std::string operator()(const Other&) const {
    return "its light is less than single precision can hold";
  }
};

std::string darkness(const ShapeDescription& shape) {
  if (const auto* file = std::get_if<MeshDescription>(&shape.geometry))
    if (triangles_without_area(*file->mesh) == file->mesh->triangles.size())
      return "no triangle of '" + file->filename + "' has an area";
  if (std::holds_alternative<TextureIndex>(*shape.radiance)) return "its texture is 0 wherever the shape shows it";
  return "its light is less than single precision can hold";
}

void add_light_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  const auto is_dark = [&](std::size_t light) { return !(max_component(flux(scene.lights[light])) > 0); };
  // Lights are those of the shapes, one a surface, and then the emitters.
  std::size_t light = 0;
  for (const ShapeDescription& shape : description.shapes) {
    if (!shape.radiance) continue;
    const std::size_t first = light;
    light += surfaces_of(shape);
    const auto* radiance = std::get_if<RgbD>(&*shape.radiance);
    if (radiance != nullptr && is_zero(*radiance)) continue;
    bool all_dark = true;
    for (std::size_t i = first; i < light; ++i) all_dark = all_dark && is_dark(i);
    if (all_dark) notes.add(shape.loc, "the shape emits nothing: " + darkness(shape));
  }
  for (const EmitterDescription& emitter : description.emitters) {
    const std::size_t own = light++;
    if (const auto* sky = std::get_if<SunSkyDescription>(&emitter.light))
      notes.limit(emitter.loc, "sun_aperture", sky->sun_aperture_degrees, usable_sun_aperture);
    if (!std::visit([](const auto& d) { return d.is_dark(); }, emitter.light) && is_dark(own))
      notes.add(emitter.loc, "the light emits nothing: " + std::visit(Darkness{}, emitter.light));
  }
}

/// An irradiancemeter has light from random rays alone, as in Mitsuba.
void add_meter_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  if (!std::holds_alternative<IrradianceMeterDescription>(description.sensor.camera)) return;
  const char* instead = "; a white diffuse floor shows it, as its radiance times pi";
  if (std::ranges::any_of(scene.lights, [](const Light& light) { return is_delta(light); }))
    notes.add(description.sensor.loc,
              std::string("an irradiancemeter does not measure lights without size, which no ray meets") + instead);
  if (std::ranges::any_of(description.emitters, [](const EmitterDescription& emitter) {
        return std::holds_alternative<SunSkyDescription>(emitter.light);
      }))
    notes.add(description.sensor.loc,
              std::string("an irradiancemeter hardly measures the sun, which few of its rays meet") + instead);
}

}  // namespace

std::vector<SceneNote> scene_notes(const SceneDescription& description, const SceneParts& scene) {
  Notes notes(description);
  notes.made = description.notes;
  for (const BsdfDescription& bsdf : description.bsdfs) std::visit(BsdfNotes{notes, bsdf.loc}, bsdf.model);
  add_mesh_notes(description, notes);
  add_light_notes(description, scene, notes);
  add_meter_notes(description, scene, notes);
  add_precision_notes(description, scene, notes);
  return std::move(notes.made);
}

}  // namespace photonproof::inline renderer_limits
