#include "renderer/scene/scene.h"

#include <cstring>
#include <set>

#include "renderer/light_sampling/light_table.h"
#include "renderer/light_sampling/scene_lights.h"
#include "renderer/rays/brute_force_tables.h"
#include "renderer/rays/rays.h"
#include "renderer/scene/find_clear_ways.h"
#include "renderer/scene/looked_at.h"
#include "renderer/scene/projection_targets.h"

namespace photonproof::inline renderer_scene {
namespace {

/// The variants' records one after the other, `List::stride` floats each.
template <class List>
std::vector<float> flat_records(const std::vector<typename List::Variant>& variants) {
  std::vector<float> records(variants.size() * List::stride, 0.0f);
  for (std::size_t i = 0; i < variants.size(); ++i)
    std::visit([&](const auto& record) { std::memcpy(&records[i * List::stride], &record, sizeof record); },
               variants[i]);
  return records;
}

std::vector<SurfaceWords> words_of_surfaces(const SceneParts& parts) {
  if (parts.surfaces.empty()) return {{0, 0, no_index, no_index, no_index}};  // what rays that miss gather
  std::vector<SurfaceWords> words;
  for (const Surface& s : parts.surfaces)
    words.push_back({parts.bsdfs.kind(s.bsdf), s.bsdf, s.light, s.interior, s.exterior});
  return words;
}

/// `small`: null where there is none.
std::vector<LightWords> words_of_lights(const SceneParts& parts, const BruteForceTables* small) {
  const std::vector<double>& given = parts.light_probabilities;
  std::vector<LightWords> words = given.empty() ? light_table(parts.lights) : light_table(parts.lights, given);
  const std::vector<std::uint32_t> faces = light_faces(parts.surfaces);
  for (std::uint32_t i = 0; i < parts.surfaces.size(); ++i)
    if (const std::uint32_t light = parts.surfaces[i].light; light != no_index)
      words[light].primitive = small != nullptr ? small->first_primitive(i) : light_face | faces[i];
  return words;
}

}  // namespace

Scene::Scene(SceneParts parts, const SceneChoices& choices)
    : SceneParts(std::move(parts)),
      small_(choices.small ? std::make_unique<const BruteForceTables>(surfaces) : nullptr),
      tracer_(choices.small ? nullptr : std::make_unique<const Tracer>(surfaces)),
      surface_words_(words_of_surfaces(*this)),
      bsdf_records_(flat_records<BsdfKinds>(bsdfs.records)),
      light_records_(light_records(lights)),
      light_words_(words_of_lights(*this, small_.get())),
      projection_targets_(
          projection_targets(surfaces, [&](const Surface& surface) { return bsdfs.is_specular(surface.bsdf); })),
      clear_ways_(choices.light_paths ? find_clear_ways(*this) : ClearWays{}),
      detail_{surfaces, uv_frames, *textures, bsdfs, plain, small_ ? small_->triangles() : nullptr},
      scene_lights_(std::make_unique<SceneLights>(lights, light_words_, ball, light_probabilities.empty())),
      view_(view_of(choices)) {
  if (choices.light_paths) scene_lights_->guide_emission(EmissionGuiding(lights, looked_at(*this), ball, &clear_ways_));
  view_.guided_emission = scene_lights_->has_guide();
}

Scene::~Scene() = default;

SceneView Scene::view_of(const SceneChoices& choices) const {
  SceneView view;
  view.small = choices.small;
  if (small_ != nullptr) view.primitives = small_->view();
  view.tracer = tracer_.get();
  view.camera = camera;
  view.coordinate_floor = frame.coordinate_floor;

  view.surfaces = surface_words_.data();
  view.bsdfs = bsdf_records_.data();
  view.bsdf_kinds = bsdf_kinds;
  view.one_bsdf_kind = choices.one_bsdf_kind;
  view.detail = &detail_;
  view.detailed = choices.detailed;
  for (const BsdfNode& node : bsdfs.tree)
    view.maps_normals |= node.kind == BsdfNode::Kind::bump || node.kind == BsdfNode::Kind::normal_map;
  view.bends_normals = view.maps_normals;
  for (const Surface& surface : surfaces) view.bends_normals |= has_shading_normals(surface);

  view.lights = light_records_.data();
  view.light_words = light_words_.data();
  view.light_count = static_cast<std::uint32_t>(lights.size());
  for (const Light& light : lights) view.light_kinds |= 1u << kernel_kind(light);
  view.lights_can_be_hit = lights_can_be_hit;
  view.hides_lights = choices.hides_lights;
  view.rough_limit = rough_limit;
  view.general_lights = scene_lights_.get();
  view.environment = scene_lights_->environment().value_or(no_index);
  view.one_light = choices.one_light;
  view.lights_by_position = choices.lights_by_position;
  view.dark_shadow_rays = choices.dark_shadow_rays;
  view.clear_ways = &clear_ways_;
  view.projection_targets = projection_targets_.data();
  view.projection_target_count = static_cast<std::uint32_t>(projection_targets_.size());
  return view;
}

std::size_t Scene::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(surfaces) + bytes(boxes) + bytes(bsdfs.records) + bytes(lights) + bytes(surface_words_) +
                      bytes(light_words_) + bytes(bsdf_records_) + bytes(light_records_) + bytes(uv_frames) +
                      bytes(plain) + textures->bytes();
  std::set<const void*> counted;  // what shapes share counts once
  const auto add_mesh = [&](const Mesh& mesh) {
    if (!counted.insert(&mesh).second) return;
    total += bytes(mesh.positions) + bytes(mesh.normals);
    const TriangleMesh& source = *mesh.source;
    if (!counted.insert(&source).second) return;
    total += bytes(source.positions) + bytes(source.triangles) + bytes(source.normals) + bytes(source.uvs);
  };
  for (const Surface& surface : surfaces) {
    if (const Mesh* mesh = mesh_of(surface.geometry)) add_mesh(*mesh);
    if (const auto* curves = std::get_if<Curves>(&surface.geometry))
      total += bytes(curves->points) + bytes(curves->segments);
    if (const Ellipsoids* cloud = ellipsoids_of(surface.geometry)) {
      total += bytes(cloud->places);
      if (counted.insert(cloud->cloud.get()).second)
        total += bytes(cloud->cloud->ellipsoids) + bytes(cloud->cloud->opacities) + bytes(cloud->cloud->harmonics);
    }
    if (const auto* sdf = std::get_if<SdfGrid>(&surface.geometry);
        sdf != nullptr && counted.insert(sdf->grid.get()).second)
      total += bytes(sdf->grid->values);
  }
  return total;
}

Hit Scene::intersect(const Vec3f& origin, const Vec3f& direction) const {
  const SurfaceHit<float> hit = closest_hit<float>(view_, origin, direction, no_index, true, false);
  if (!hit.valid) return {};
  return {hit.surface, hit.p, hit.normal};
}

}  // namespace photonproof::inline renderer_scene
