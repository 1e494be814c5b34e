#include "renderer/limits/precision_notes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "renderer/limits/close_faces.h"
#include "renderer/limits/grazing_lights.h"
#include "renderer/limits/near_lights.h"
#include "renderer/scene/scene_focus.h"
#include "renderer/shapes/cylinder.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/shape.h"
#include "renderer/shapes/sphere.h"

namespace photonproof::inline renderer_limits {

std::size_t surfaces_of(const ShapeDescription& shape) {
  return std::visit([]<class Kind>(const Kind&) -> std::size_t { return Kind::surfaces; }, shape.geometry);
}

std::vector<SourceLoc> places_of_lights(const SceneDescription& description) {
  std::vector<SourceLoc> places;
  for (const ShapeDescription& shape : description.shapes)
    if (shape.radiance) places.insert(places.end(), surfaces_of(shape), shape.loc);
  for (const EmitterDescription& emitter : description.emitters) places.push_back(emitter.loc);
  return places;
}

namespace {

/// With fewer steps of a direction's coordinates per pixel, its samples form stripes.
constexpr double least_steps_a_pixel = 4;

/// Approximate angle of a film's pixel at the middle of the camera's view, in radians.
struct PixelAngle {
  const FilmDescription& film;

  double operator()(const PerspectiveDescription& camera) const {
    return 2 * std::tan(camera.fov_degrees * std::numbers::pi / 360) / std::max(film.width, film.height);
  }
  double operator()(const ThinLensDescription& camera) const { return (*this)(camera.perspective); }
  double operator()(const FisheyeDescription& camera) const {
    return camera.fov_degrees * std::numbers::pi / 180 / std::min(film.width, film.height);
  }
  double operator()(const BatchDescription& batch) const {
    double least = std::numeric_limits<double>::infinity();
    for (const BatchView& view : batch.views) least = std::min(least, std::visit(*this, view.camera));
    return least;
  }
  /// An orthographic camera's or a meter's.
  template <class Other>
  double operator()(const Other&) const {
    return std::numeric_limits<double>::infinity();
  }
};

/// Allowed miss of the point in focus by rays from all over a lens, as a part of a pixel. Also the largest tangent of
/// half a field of view: there a step of its outermost directions is a hundredth of their cosine.
constexpr double part_of_a_pixel = 0.1, widest_tangent = 0.01 / float_step;

void add_camera_notes(const SceneDescription& description, Notes& notes) {
  const SensorDescription& sensor = description.sensor;
  const double pixel = std::visit(PixelAngle{sensor.film}, sensor.camera);
  if (pixel < least_steps_a_pixel * float_step)
    notes.add(sensor.loc, "a pixel is " + short_number(pixel) +
                              " radians wide, and directions in single precision are " + short_number(float_step) +
                              " apart: an orthographic camera near the scene is more exact");
  const auto* lens = std::get_if<ThinLensDescription>(&sensor.camera);
  const auto* pinhole = lens != nullptr ? &lens->perspective : std::get_if<PerspectiveDescription>(&sensor.camera);
  if (pinhole != nullptr && std::tan(pinhole->fov_degrees * std::numbers::pi / 360) > widest_tangent)
    notes.add(sensor.loc, "the field of view is " + short_number(180 - pinhole->fov_degrees) +
                              " degrees below 180, and directions in single precision are " + short_number(float_step) +
                              " apart: objects at its edges may be elsewhere");
  if (lens == nullptr) return;
  // Each component of a direction is rounded by a step of the largest; the error then grows with the lens's width.
  const double slope = std::max(1.0, lens->aperture_radius / lens->focus_distance);
  const double missed = lens->aperture_radius * slope * float_step, in_focus = pixel * lens->focus_distance;
  if (missed > part_of_a_pixel * in_focus)
    notes.add(sensor.loc, "rays through a lens of radius " + short_number(lens->aperture_radius) +
                              " miss the point in focus by " + short_number(missed) +
                              " in single precision, and a pixel is " + short_number(in_focus) + " wide there");
}

/// A cone narrower than this many steps of directions may be missed.
constexpr double least_steps_a_cone = 16;

void add_cone_notes(const SceneDescription& description, Notes& notes) {
  for (const EmitterDescription& emitter : description.emitters) {
    const auto* spot = std::get_if<SpotLightDescription>(&emitter.light);
    if (spot == nullptr) continue;
    const double angle = spot->cutoff_degrees * std::numbers::pi / 180;
    if (angle < least_steps_a_cone * float_step)
      notes.add(emitter.loc, "the cone is " + short_number(angle) +
                                 " radians wide, and directions in single precision are " + short_number(float_step) +
                                 " apart: its light may be missed");
  }
}

/// Fewest coordinate steps in a step of a random walk, and most scatterings in it. With more, the estimate depends on
/// the few paths that survive roulette.
constexpr double least_steps_a_flight = 4, most_scatterings = 1e4;

/// `reach` is the largest coordinate of the filled region, `radius` half of its size, both in the frame's unit.
void add_notes_of_medium(const MediumDescription& medium, double scale, double reach, double radius, Notes& notes) {
  const auto [most_extinction, most_scattering] = bounds_of(medium);
  const auto* lobe = std::get_if<HenyeyGreensteinDescription>(&phase_of(medium));
  const double g = lobe != nullptr ? lobe->g : 0;
  double densest = 0, scatterings = 0;
  for (const auto& [sigma_t, sigma_s] : {std::pair{most_extinction.x, most_scattering.x},
                                         {most_extinction.y, most_scattering.y},
                                         {most_extinction.z, most_scattering.z}}) {
    if (!(sigma_s > 0)) continue;
    const double extinction = sigma_t / scale, depth = extinction * radius, albedo = sigma_s / sigma_t;
    densest = std::max(densest, extinction);
    // Scatterings of a random walk to the middle, its steps correlated by g, and before absorption.
    scatterings = std::max(scatterings, std::min(0.5 * depth * depth * (1 - g), 1 / (1 - albedo)));
  }
  if (1 < least_steps_a_flight * float_step * reach * densest)
    notes.add(medium.loc, "light goes " + short_number(1 / densest / scale) + " between its scatterings in '" +
                              medium.id + "', where coordinates in single precision are " +
                              short_number(float_step * reach / scale) + " apart: it may get nowhere");
  else if (scatterings > most_scatterings)
    notes.add(medium.loc, "light is scattered some " + short_number(scatterings) + " times on its way through '" +
                              medium.id + "': few paths are followed so far, and the error may exceed what they show");
}

void add_medium_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  if (description.media.empty()) return;
  const double scale = scene.frame.scale;
  struct Filled {
    double reach = 0, radius = 0;
  };
  std::map<std::uint32_t, Filled> media;
  const auto add = [&](const MediumIndex& medium, double reach, double radius) {
    Filled& filled = media[medium.value];
    filled = {std::max(filled.reach, reach), std::max(filled.radius, radius)};
  };
  const ShapeExtents extents(description);
  for (const ShapeDescription& shape : description.shapes) {
    if (!shape.interior) continue;
    const Extent extent = extents.of(shape);
    if (!extent.is_usable()) continue;
    const Vec3d low = extent.low * scale + scene.frame.moved, high = extent.high * scale + scene.frame.moved;
    add(*shape.interior, std::max(largest_coordinate(low), largest_coordinate(high)), 0.5 * length(high - low));
  }
  if (description.sensor.medium)
    add(*description.sensor.medium, double{scene.ball.radius} + largest_coordinate(Vec3d(scene.ball.center)),
        double{scene.ball.radius});
  for (const auto& [medium, filled] : media)
    add_notes_of_medium(description.media[medium], scale, filled.reach, filled.radius, notes);
}

/// Largest step of coordinates as a part of the visible scene, and for lights, since a large light is far away.
constexpr double part_of_what_is_seen = 1e-4, part_of_a_light = 0.01;
/// Largest error of an edge, as a part of the view.
constexpr double part_of_a_view = 1e-3;

void add_place_notes(const SceneDescription& description, const SceneFocus& focus, Notes& notes) {
  const double place = largest_coordinate(focus.point);
  if (place * double_step > part_of_what_is_seen * focus.size)
    notes.add(description.sensor.loc, "the part in view is " + short_number(focus.size) + " large and lies at " +
                                          short_number(place) + ", where coordinates in double precision are " +
                                          short_number(place * double_step) + " apart");
  for (const ShapeDescription& shape : description.shapes) {
    const auto* ball = std::get_if<SphereDescription>(&shape.geometry);
    const auto* pillar = std::get_if<CylinderDescription>(&shape.geometry);
    if ((ball == nullptr && pillar == nullptr) || !shape.radiance) continue;
    const Extent extent = ball != nullptr ? extent_of(*ball, shape.to_world) : extent_of(*pillar, shape.to_world);
    const double reach = std::max(largest_coordinate(extent.low), largest_coordinate(extent.high));
    if (reach * double_step > part_of_a_light * focus.size)
      notes.add(shape.loc, "the light reaches to " + short_number(reach) +
                               ", where coordinates in double precision are " + short_number(reach * double_step) +
                               " apart: a constant emitter or a disk shines more exactly");
  }
}

/// Faces so long that double precision does not resolve their ends, where the camera looks.
void add_long_face_notes(const SceneDescription& description, const SceneFocus& focus, const SceneParts& scene,
                         Notes& notes) {
  const double size = focus.size * scene.frame.scale;
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
                  description.where(description.shapes[close.first].loc) + ", and distances below " +
                  short_number(close.resolved) + " count as one face there");
}

/// One note for each light; for many lights, notes for the first ones and the number of the others.
template <class LightFound, class Text>
void add_notes_of_lights(const SceneDescription& description, const std::vector<LightFound>& lights, Notes& notes,
                         const Text& text) {
  constexpr std::size_t most = 16;
  if (lights.empty()) return;
  const std::vector<SourceLoc> places = places_of_lights(description);
  for (std::size_t i = 0; i < lights.size() && i < most; ++i)
    notes.add(places[lights[i].light],
              text(lights[i]) +
                  (i + 1 == most && lights.size() > most
                       ? "; it is alike with " + std::to_string(lights.size() - most) + " more lights after this one"
                       : ""));
}

void add_grazing_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  add_notes_of_lights(description, grazing_lights(scene), notes, [](const GrazingLight& light) {
    const std::string height = short_number(light.height);
    return (light.from_one_side ? "the light's angle to a face has the sine " + height
                                : "the light is " + height + " above a surface") +
           ", which single precision resolves to " + short_number(light.rounding) + ": light that grazes it there " +
           (light.loss() < 1 ? "may be off by " + short_number(100 * light.loss()) + " %" : "is not known");
  });
}

void add_hidden_light_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  add_notes_of_lights(description, lights_above_spots(scene, 0), notes, [](const NearLight&) -> std::string {
    return "the light lies in a surface: integrators differ in whether it lights it";
  });
  add_notes_of_lights(description, lights_on_surfaces(scene), notes, [](const NearLight& area_light) {
    return "the light is " + short_number(area_light.height) +
           " from a surface, and rays there do not separate surfaces less than " + short_number(area_light.resolved) +
           " apart: either may hide the other";
  });
}

/// With fewer camera paths than this in a spot, over the whole image, pixels and blocks do not show how much they miss.
constexpr double least_paths_a_spot = 1000;

}  // namespace

void add_precision_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes) {
  add_camera_notes(description, notes);
  add_cone_notes(description, notes);
  add_medium_notes(description, scene, notes);
  if (const std::optional<SceneFocus> focus = scene_focus(description)) {
    add_place_notes(description, *focus, notes);
    add_long_face_notes(description, *focus, scene, notes);
  }
  add_close_face_notes(description, scene, notes);
  add_grazing_notes(description, scene, notes);
  add_hidden_light_notes(description, scene, notes);
}

std::vector<SceneNote> notes_on_missed_spots(const SceneDescription& description, const SceneParts& scene,
                                             double camera_paths) {
  Notes notes(description);
  const std::optional<SceneFocus> focus = scene_focus(description);
  if (!focus || !(camera_paths > 0)) return {};
  // A point's irradiance at r from the foot of its height h falls as (r^2 + h^2)^-1.5. Its square integrates as if it
  // were even over an area of 8 pi h^2.
  const double area = focus->size * focus->size, spot = 8 * std::numbers::pi;
  const double highest = std::sqrt(least_paths_a_spot * area / (spot * camera_paths));
  const std::vector<NearLight> low = lights_above_spots(scene, std::min(highest, 0.1 * focus->size));
  add_notes_of_lights(description, low, notes, [&](const NearLight& area_light) {
    return "the light is " + short_number(area_light.height) +
           " above a surface, and its brightest spot there is reached by " +
           short_number(camera_paths * spot * area_light.height * area_light.height / area) + " of " +
           short_number(camera_paths) +
           " camera paths: the variance may be too small. Integrators that also trace light paths find the spot";
  });
  return std::move(notes.made);
}

}  // namespace photonproof::inline renderer_limits
