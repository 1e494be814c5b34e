#include "renderer/scene/scene_notes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "renderer/bsdfs/bsdf_phong.h"
#include "renderer/bsdfs/microfacet.h"
#include "renderer/lights/sky_sun.h"
#include "renderer/scene/close_faces.h"
#include "renderer/scene/grazing_lights.h"
#include "renderer/scene/scene_focus.h"
#include "renderer/shapes/cylinder.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/shape.h"
#include "renderer/shapes/sphere.h"
#include "scenes/text/text_numbers.h"

namespace photonproof {
namespace {

class Notes {
 public:
  explicit Notes(const SceneDescription& description) : description_(description) {}

  std::vector<SceneNote> made;

  void add(const SourceLoc& loc, const std::string& text) { made.push_back({description_.where(loc), text}); }

  /// A number that is rendered as `rendered(number)`; what textures give is held to the same limits without a word.
  template <class Rendered>
  void limit(const SourceLoc& loc, const char* name, const Scalar& value, const Rendered& rendered) {
    const auto* asked = std::get_if<double>(&value);
    if (asked == nullptr) return;
    const auto number = static_cast<float>(*asked);
    if (rendered(number) == number) return;
    char text[16];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(rendered(number)));
    add(loc, std::string(name) + " " + format_number(*asked) + " is rendered as " + text);
  }

 private:
  const SceneDescription& description_;
};

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
        !requires { d.exponent; }, "which exponents are usable is for each BSDF to say");
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
  return static_cast<std::size_t>(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Vec3d a(mesh.positions[t[0]]);
    return cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a) == Vec3d(0.0);
  }));
}

void add_mesh_notes(const SceneDescription& description, Notes& notes) {
  std::set<const TriangleMesh*> known;  // a file that several shapes share is told of once
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

/// What it is that has no light in it.
struct Darkness {
  std::string operator()(const IesLightDescription& d) const { return "every candela of '" + d.filename + "' is 0"; }
  std::string operator()(const EnvmapDescription& d) const { return "every pixel of '" + d.filename + "' is 0"; }
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

/// The number of surfaces that a shape becomes, each a light where the shape emits.
std::size_t surfaces_of(const ShapeDescription& shape) {
  return std::visit([]<class Kind>(const Kind&) -> std::size_t { return Kind::surfaces; }, shape.geometry);
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

/// Of a float near 1, and of a double.
constexpr double float_step = 0x1p-23, double_step = 0x1p-52;

std::string short_number(double x) {
  char text[24];
  std::snprintf(text, sizeof text, "%.2g", x);
  return text;
}

/// Below so many steps of a direction's coordinates a pixel's samples show it as stripes.
constexpr double least_steps_a_pixel = 4;

/// Of a film's pixel, about, as seen through the middle of a camera: radians.
struct PixelAngle {
  const FilmDescription& film;

  double operator()(const PerspectiveDescription& camera) const {
    return 2 * std::tan(camera.fov_degrees * std::numbers::pi / 360) / std::max(film.width, film.height);
  }
  double operator()(const ThinLensDescription& camera) const { return (*this)(camera.perspective); }
  double operator()(const FisheyeDescription& camera) const {
    return camera.fov_degrees * std::numbers::pi / 180 / std::min(film.width, film.height);
  }
  double operator()(const OrthographicDescription&) const { return std::numeric_limits<double>::infinity(); }
};

/// What rays from all over a lens may miss the point in focus by: this part of a pixel.
constexpr double part_of_a_pixel = 0.1;

void add_camera_notes(const SceneDescription& description, Notes& notes) {
  const SensorDescription& sensor = description.sensor;
  const double pixel = std::visit(PixelAngle{sensor.film}, sensor.camera);
  if (pixel < least_steps_a_pixel * float_step)
    notes.add(sensor.loc, "a pixel is " + short_number(pixel) +
                              " radians wide, and directions in single precision are " + short_number(float_step) +
                              " apart: what is so far away is seen better by an orthographic camera near it");
  const auto* lens = std::get_if<ThinLensDescription>(&sensor.camera);
  if (lens == nullptr) return;
  const double missed = lens->aperture_radius * float_step, in_focus = pixel * lens->focus_distance;
  if (missed > part_of_a_pixel * in_focus)
    notes.add(sensor.loc, "rays through a lens of radius " + short_number(lens->aperture_radius) +
                              " miss the point in focus by " + short_number(missed) +
                              " in single precision, and a pixel is " + short_number(in_focus) + " wide there");
}

/// Steps of a walk may be so many steps of its coordinates, and it may have so many before what is known of its
/// light depends on a few that survive roulette.
constexpr double least_steps_a_flight = 4, most_scatterings = 1e4;

/// `reach` and `radius` of what it fills: how far its coordinates go, and half of its size; in the frame's unit.
void add_notes_of_medium(const MediumDescription& medium, double scale, double reach, double radius, Notes& notes) {
  const auto& fog = std::get<HomogeneousDescription>(medium.model);
  const auto* lobe = std::get_if<HenyeyGreensteinDescription>(&fog.phase);
  const double g = lobe != nullptr ? lobe->g : 0;
  double densest = 0, scatterings = 0;
  for (const auto& [sigma, albedo] :
       {std::pair{fog.sigma_t.x, fog.albedo.x}, {fog.sigma_t.y, fog.albedo.y}, {fog.sigma_t.z, fog.albedo.z}}) {
    if (!(albedo > 0)) continue;
    const double extinction = sigma * fog.scale / scale, depth = extinction * radius;
    densest = std::max(densest, extinction);
    // Of a random walk to the middle, its steps correlated by g; and before it is absorbed.
    scatterings = std::max(scatterings, std::min(0.5 * depth * depth * (1 - g), 1 / (1 - albedo)));
  }
  if (1 < least_steps_a_flight * float_step * reach * densest)
    notes.add(medium.loc, "light goes " + short_number(1 / densest / scale) + " between its scatterings in '" +
                              medium.id + "', where coordinates in single precision are " +
                              short_number(float_step * reach / scale) + " apart: it may get nowhere");
  else if (scatterings > most_scatterings)
    notes.add(medium.loc, "light is scattered some " + short_number(scatterings) + " times on its way through '" +
                              medium.id + "': few paths are followed so far, and the error may be more than they show");
}

void add_medium_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  const double scale = scene.frame.scale;
  std::set<std::uint32_t> known;
  for (const ShapeDescription& shape : description.shapes) {
    if (!shape.interior || known.contains(shape.interior->value)) continue;
    const Extent extent = extent_of(description, shape);
    if (!extent.is_usable()) continue;
    known.insert(shape.interior->value);
    const Vec3d low = extent.low * scale + scene.frame.moved, high = extent.high * scale + scene.frame.moved;
    add_notes_of_medium(description.media[shape.interior->value], scale,
                        std::max(largest_coordinate(low), largest_coordinate(high)), 0.5 * length(high - low), notes);
  }
}

/// What steps of coordinates may be of what is seen, and those of a lamp, which is far away where it is large.
constexpr double part_of_what_is_seen = 1e-4, part_of_a_lamp = 0.01;
/// And what edges may be off by.
constexpr double part_of_a_view = 1e-3;

void add_place_notes(const SceneDescription& description, Notes& notes) {
  const std::optional<SceneFocus> focus = scene_focus(description);
  if (!focus) return;
  const double place = largest_coordinate(focus->point);
  if (place * double_step > part_of_what_is_seen * focus->size)
    notes.add(description.sensor.loc, "what is seen is " + short_number(focus->size) + " large and lies at " +
                                          short_number(place) + ", where coordinates in double precision are " +
                                          short_number(place * double_step) + " apart");
  for (const ShapeDescription& shape : description.shapes) {
    const auto* ball = std::get_if<SphereDescription>(&shape.geometry);
    const auto* pillar = std::get_if<CylinderDescription>(&shape.geometry);
    if ((ball == nullptr && pillar == nullptr) || !shape.radiance) continue;
    const Extent extent = ball != nullptr ? extent_of(*ball, shape.to_world) : extent_of(*pillar, shape.to_world);
    const double reach = std::max(largest_coordinate(extent.low), largest_coordinate(extent.high));
    if (reach * double_step > part_of_a_lamp * focus->size)
      notes.add(shape.loc, "the lamp reaches to " + short_number(reach) +
                               ", where coordinates in double precision are " + short_number(reach * double_step) +
                               " apart: a constant emitter or a disk shines more exactly");
  }
}

/// Faces so long that double precision does not know where they end, which is where one looks.
void add_long_face_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  const std::optional<SceneFocus> focus = scene_focus(description);
  if (!focus) return;
  const double size = focus->size * scene.frame.scale;
  double longest = 0;
  for (const Surface& surface : scene.surfaces)
    if (surface.long_faces != nullptr)
      for (const LongFace& face : *surface.long_faces) {
        const double edge = std::max(length(face.edge_u), length(face.edge_v));
        if (edge * long_face_margin > part_of_a_view * std::max(size, rim_distance(face)))
          longest = std::max(longest, edge);
      }
  if (longest > 0)
    notes.add(description.sensor.loc, "a face is " + short_number(longest / scene.frame.scale) +
                                          " long and ends near what is seen, which is known to " +
                                          short_number(longest * long_face_margin / scene.frame.scale) +
                                          " in double precision");
}

void add_close_face_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  for (const CloseFaces& close : close_faces_of_glass(description, scene.frame))
    notes.add(description.shapes[close.second].loc,
              "a face of glass is " + short_number(close.apart) + " from one of the shape at " +
                  description.where(description.shapes[close.first].loc) + ", and what is less than " +
                  short_number(close.resolved) + " apart there light may take for one");
}

/// Of each of the scene's lights: those of the shapes, one a surface, and then the emitters.
std::vector<SourceLoc> places_of_lights(const SceneDescription& description) {
  std::vector<SourceLoc> places;
  for (const ShapeDescription& shape : description.shapes)
    if (shape.radiance) places.insert(places.end(), surfaces_of(shape), shape.loc);
  for (const EmitterDescription& emitter : description.emitters) places.push_back(emitter.loc);
  return places;
}

void add_grazing_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  const std::vector<GrazingLight> grazing = grazing_lights(scene);
  if (grazing.empty()) return;
  const std::vector<SourceLoc> places = places_of_lights(description);
  for (const GrazingLight& light : grazing) {
    const std::string height = short_number(light.height);
    notes.add(places[light.light],
              (light.from_one_side ? "the light's angle to a face has the sine " + height
                                   : "the lamp is " + height + " above a surface") +
                  ", which single precision knows to " + short_number(light.rounding) +
                  ": light that grazes it there " +
                  (light.loss() < 1 ? "may be off by " + short_number(100 * light.loss()) + " %" : "is not known"));
  }
}

}  // namespace

std::vector<SceneNote> scene_notes(const SceneDescription& description, const SceneParts& scene) {
  Notes notes(description);
  for (const BsdfDescription& bsdf : description.bsdfs) std::visit(BsdfNotes{notes, bsdf.loc}, bsdf.model);
  add_mesh_notes(description, notes);
  add_light_notes(description, scene, notes);
  add_camera_notes(description, notes);
  add_medium_notes(description, scene, notes);
  add_place_notes(description, notes);
  add_long_face_notes(description, scene, notes);
  add_close_face_notes(description, scene, notes);
  add_grazing_notes(description, scene, notes);
  return std::move(notes.made);
}

}  // namespace photonproof
