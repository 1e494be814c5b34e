#include "renderer/scene/scene_parts.h"

#include <algorithm>
#include <map>
#include <optional>

#include "renderer/lights/compile_light.h"
#include "renderer/media/varying_medium.h"
#include "renderer/scene/mesh_attributes.h"
#include "renderer/scene/scaled_description.h"
#include "renderer/scene/scene_shapes.h"
#include "renderer/shapes/local_geometry.h"

namespace photonproof::inline renderer_scene {
namespace {

/// The lights of surfaces that emit; their indices are stored in the surfaces.
std::vector<Light> surface_lights(const SceneDescription& description, const Vec3d& moved, const TextureLookup& texture,
                                  SceneShapes& shapes) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < shapes.surfaces.size(); ++i) {
    const ShapeDescription& shape = *shapes.shape_of[i];
    if (!shape.radiance) continue;
    Surface& surface = shapes.surfaces[i];
    surface.light = static_cast<std::uint32_t>(lights.size());
    const Transform to_world = Transform::translate(moved) * shape.to_world;
    lights.push_back(compile_surface_light(surface, shape, to_world, texture, description.where(shape.loc)));
  }
  return lights;
}

/// Mitsuba's probabilities of its emitters, which are even, where a light's image depends on them; else empty. The
/// surfaces of one shape share theirs by flux.
std::vector<double> probabilities_as_mitsuba(const SceneDescription& description, const SceneShapes& shapes,
                                             const std::vector<Light>& lights) {  // of surfaces
  const auto depends = [](const ShapeDescription& shape) { return shape.emits_by_vertex_normals; };
  if (std::ranges::none_of(description.shapes, depends)) return {};
  std::map<const ShapeDescription*, double> flux_of;
  const auto mean_flux = [&](std::size_t light) {
    const Rgb f = flux(lights[light]);
    return std::max((double{f.x} + f.y + f.z) / 3, 1e-30);
  };
  for (std::size_t i = 0; i < shapes.surfaces.size(); ++i)
    if (shapes.surfaces[i].light != no_index) flux_of[shapes.shape_of[i]] += mean_flux(shapes.surfaces[i].light);
  const double even = 1 / static_cast<double>(flux_of.size() + description.emitters.size());
  std::vector<double> probabilities(lights.size() + description.emitters.size(), even);
  for (std::size_t i = 0; i < shapes.surfaces.size(); ++i)
    if (const std::uint32_t light = shapes.surfaces[i].light; light != no_index)
      probabilities[light] = even * mean_flux(light) / flux_of.at(shapes.shape_of[i]);
  return probabilities;
}

/// Whether hits need no details (surface_detail.h).
bool is_plain(const BsdfTable& bsdfs, const Surface& surface) {
  const BsdfNode& node = bsdfs.tree[surface.bsdf];
  return node.kind == BsdfNode::Kind::leaf && node.slots.empty() && !node.has_directions &&
         !has_shading_normals(surface);
}

}  // namespace

SceneParts::SceneParts(const SceneDescription& in_its_unit, int width_, int height_)
    : width(width_),
      height(height_),
      frame(scene_frame(in_its_unit)),
      filter(in_its_unit.sensor.film.filter),
      sample_border(in_its_unit.sensor.film.sample_border) {
  std::optional<SceneDescription> in_other_unit;
  if (frame.scale != 1) in_other_unit = scaled(in_its_unit, frame.scale);
  const SceneDescription& description = in_other_unit ? *in_other_unit : in_its_unit;

  textures = std::make_shared<const Textures>(description.textures, VolumeFrame{frame.moved, frame.scale});
  media = compile_media(description, {frame.moved, frame.scale});
  bsdfs = compile_bsdfs(description);
  SceneShapes shapes(description, *textures, frame.moved, frame.long_edge);
  lights = surface_lights(description, frame.moved, TextureLookup(textures), shapes);
  light_probabilities = probabilities_as_mitsuba(description, shapes, lights);
  surfaces = std::move(shapes.surfaces);
  cubes = std::move(shapes.cubes);
  uv_frames = std::move(shapes.uv_frames);
  primitives = shapes.primitives;
  simple_primitives = shapes.simple;
  boxes = boxes_around(surfaces);
  ball = scene_ball(boxes);
  for (const EmitterDescription& e : description.emitters)
    lights.push_back(compile_light(e, frame.moved, ball, TextureLookup(textures), description.where(e.loc)));
  lights_can_be_hit = std::ranges::any_of(lights, [](const Light& light) { return !is_delta(light); });
  if (std::ranges::any_of(lights, [](const Light& light) { return is_delta(light); }))
    rough_limit = rough_limit_of_points;
  check_mesh_attributes(description, *textures, bsdfs, surfaces, shapes.shape_of);
  for (const Surface& surface : surfaces) {
    plain.push_back(is_plain(bsdfs, surface) ? 1 : 0);
    bsdfs.for_each_leaf(surface.bsdf, [&](const Bsdf& leaf, bool) { bsdf_kinds |= 1u << leaf.index(); });
  }
  camera = compile_camera(
      description.sensor, width, height,
      {frame.moved, Vec3d(ball.center), ball.radius, frame.coordinate_floor, measuring_shape(description)});
  camera_parts =
      std::make_shared<const std::vector<CameraView>>(compile_parts(description.sensor, width, height, frame.moved));
  camera.part_count = static_cast<std::uint32_t>(camera_parts->size());
  camera.parts = camera_parts->data();
}

}  // namespace photonproof::inline renderer_scene
