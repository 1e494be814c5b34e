#include "renderer/scene/scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>

#include "renderer/bsdfs/compile_bsdf.h"
#include "renderer/light_choice/light_table.h"
#include "renderer/light_choice/scene_lights.h"
#include "renderer/lights/compile_light.h"
#include "renderer/rays/rays.h"
#include "renderer/rays/small_scene_tables.h"
#include "renderer/scene/aim_targets.h"
#include "renderer/scene/looked_at.h"
#include "renderer/scene/scaled_description.h"
#include "renderer/scene/scene_frame.h"
#include "renderer/scene/scene_shapes.h"

namespace photonproof {
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

/// What lights look textures up with.
TextureLookup texture_lookup(const Textures& textures) {
  return [&textures](TextureIndex texture) -> LightTexture {
    return [&textures, texture](const Vec2<float>& uv) { return textures.colour(texture.value, uv); };
  };
}

}  // namespace

/// The description in the scene's unit of length.
struct Scene::Framed {
  SceneFrame frame;
  std::optional<SceneDescription> in_other_unit;
  const SceneDescription& description;

  explicit Framed(const SceneDescription& d)
      : frame(scene_frame(d)),
        in_other_unit(frame.scale != 1 ? std::optional(scaled(d, frame.scale)) : std::nullopt),
        description(in_other_unit ? *in_other_unit : d) {}
};

Scene::Scene(const SceneDescription& description, int width_, int height_, const SkipSwitches& skips,
             std::size_t small_limit, ScenePurpose purpose)
    : Scene(Framed(description), width_, height_, skips, small_limit, purpose) {}

Scene::Scene(const Framed& framed, int width_, int height_, const SkipSwitches& skips, std::size_t small_limit,
             ScenePurpose purpose)
    : width(width_),
      height(height_),
      textures(framed.description.textures),
      media(compile_media(framed.description)),
      filter(framed.description.sensor.film.filter),
      scale_(framed.frame.scale),
      moved_(framed.frame.moved),
      detail_(surfaces, textures) {
  const SceneDescription& description = framed.description;
  compile_bsdfs(description);
  SceneShapes shapes(description, textures, moved_, framed.frame.long_edge);
  surfaces = std::move(shapes.surfaces);
  primitives_ = shapes.primitives;
  add_surface_lights(description, shapes);
  const SceneBall ball = scene_ball(surfaces);
  for (const EmitterDescription& e : description.emitters)
    lights.push_back(compile_light(e, moved_, ball, texture_lookup(textures), description.where(e.loc)));

  view_.camera = compile_camera(description.sensor, width, height, moved_);
  view_.coordinate_floor = framed.frame.coordinate_floor;

  simple_ = shapes.simple;
  small_ = primitives_ <= small_limit && simple_ && skips.on(Skip::bvh) ? std::make_unique<SmallSceneTables>(surfaces)
                                                                        : nullptr;
  if (small_ == nullptr && purpose == ScenePurpose::render) tracer_ = std::make_unique<Tracer>(surfaces);
  view_.small = small_ != nullptr;
  if (small_ != nullptr) view_.primitives = small_->view();
  view_.tracer = tracer_.get();

  for (const Surface& surface : surfaces) {
    const auto kind = static_cast<std::uint32_t>(bsdfs[surface.bsdf].index());
    surface_words_.push_back({kind, surface.bsdf, surface.light, surface.interior, surface.exterior});
    for_each_leaf(surface.bsdf, [&](const Bsdf& leaf, bool) { view_.bsdf_kinds |= 1u << leaf.index(); });
  }
  if (surface_words_.empty())  // what rays that miss gather
    surface_words_.push_back({0, 0, no_index, no_index, no_index});
  bsdf_records_ = flat_records<BsdfKinds>(bsdfs);
  light_records_ = light_records(lights);
  light_words_ = light_table(lights);
  scene_lights_ = std::make_unique<SceneLights>(lights, light_words_, ball);
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].light != no_index)
      light_words_[surfaces[i].light].primitive = view_.small ? small_->first_primitive(i) : no_index;
  for (const Light& light : lights) {
    view_.light_kinds |= 1u << kernel_kind(light);
    view_.lights_can_be_hit |= !is_delta(light);
  }
  detail_.uv_frames = std::move(shapes.uv_frames);
  compile_detail(skips);
  view_.surfaces = surface_words_.data();
  view_.bsdfs = bsdf_records_.data();
  view_.lights = light_records_.data();
  view_.light_words = light_words_.data();
  view_.light_count = static_cast<std::uint32_t>(lights.size());
  view_.general_lights = scene_lights_.get();
  view_.lights_by_position = scene_lights_->has_tree() && skips.on(Skip::far_lights);
  view_.environment = scene_lights_->environment().value_or(no_index);
  aim_targets_ = aim_targets(surfaces, [&](const Surface& surface) {
    bool specular = false;
    for_each_leaf(surface.bsdf, [&](const Bsdf& leaf, bool) { specular = specular || !is_lambertian(leaf); });
    return specular;
  });
  view_.aim_targets = aim_targets_.data();
  view_.aim_target_count = static_cast<std::uint32_t>(aim_targets_.size());
  view_.one_light = lights.size() == 1 && skips.on(Skip::light_choice);
  view_.one_bsdf_kind = std::has_single_bit(view_.bsdf_kinds) && skips.on(Skip::bsdf_groups);
  view_.dark_shadow_rays = !skips.on(Skip::shadow_rays);
  if (purpose == ScenePurpose::render) scene_lights_->guide_emission(EmissionGuide(lights, looked_at(*this), ball));
  view_.guided_emission = scene_lights_->has_guide();
}

Scene::~Scene() = default;

void Scene::add_surface_lights(const SceneDescription& description, const SceneShapes& shapes) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const ShapeDescription& shape = *shapes.shape_of[i];
    if (!shape.radiance) continue;
    surfaces[i].light = static_cast<std::uint32_t>(lights.size());
    const Transform to_world = Transform::translate(moved_) * shape.to_world;
    lights.push_back(compile_surface_light(surfaces[i].geometry, shape, to_world, texture_lookup(textures),
                                           description.where(shape.loc)));
  }
}

void Scene::compile_bsdfs(const SceneDescription& description) {
  detail_.tree = bsdf_tree(description.bsdfs);
  bool has_holes = false;
  for (std::uint32_t i = 0; i < description.bsdfs.size(); ++i) {
    BsdfNode& node = detail_.tree[i];
    has_holes = has_holes || node.kind == BsdfNode::Kind::mask;
    if (node.kind != BsdfNode::Kind::leaf) {
      bsdfs.emplace_back();  // never looked at
      continue;
    }
    CompiledBsdf compiled = compile_bsdf(description, {i});
    bsdfs.push_back(compiled.record);
    node.slots = std::move(compiled.slots);
    node.has_directions = is_anisotropic(description, {i});
  }
  refuse_deep_maps(description);
  detail_.nothing = static_cast<std::uint32_t>(bsdfs.size());
  if (has_holes) {
    bsdfs.emplace_back(NullBsdf<float>{});
    detail_.tree.emplace_back();
  }
  for (const Bsdf& bsdf : bsdfs) detail_.kinds.push_back(static_cast<std::uint32_t>(bsdf.index()));
}

void Scene::refuse_deep_maps(const SceneDescription& description) const {
  std::vector<int> maps(detail_.tree.size(), 0);  // on the way to the deepest leaf; what is nested comes first
  for (std::size_t i = 0; i < detail_.tree.size(); ++i) {
    const BsdfNode& node = detail_.tree[i];
    if (node.kind == BsdfNode::Kind::leaf) continue;
    const bool is_map = node.kind == BsdfNode::Kind::bump || node.kind == BsdfNode::Kind::normal_map;
    maps[i] = std::max(maps[node.first], maps[node.second]) + (is_map ? 1 : 0);
    if (maps[i] > 2)
      throw InputError(description.where(description.bsdfs[i].loc),
                       "more than two bump or normal maps nest, one over the other");
  }
}

void Scene::compile_detail(const SkipSwitches& skips) {
  for (const Surface& surface : surfaces) {
    const BsdfNode& node = detail_.tree[surface.bsdf];
    const bool plain = node.kind == BsdfNode::Kind::leaf && node.slots.empty() && !node.has_directions &&
                       !has_shading_normals(surface);
    detail_.plain.push_back(plain ? 1 : 0);
    needs_detail_ = needs_detail_ || !plain;
    view_.bends_normals |= has_shading_normals(surface);
  }
  for (const BsdfNode& node : detail_.tree)
    view_.maps_normals |= node.kind == BsdfNode::Kind::bump || node.kind == BsdfNode::Kind::normal_map;
  view_.bends_normals |= view_.maps_normals;
  if (small_ != nullptr) detail_.triangles = small_->triangles();
  view_.detail = &detail_;
  view_.detailed = needs_detail_ || !skips.on(Skip::surface_detail);
}

std::size_t Scene::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(surfaces) + bytes(bsdfs) + bytes(lights) + bytes(surface_words_) + bytes(light_words_) +
                      bytes(bsdf_records_) + bytes(light_records_) + bytes(detail_.uv_frames) + bytes(detail_.plain) +
                      textures.bytes();
  std::set<const void*> counted;  // what shapes share counts once
  const auto add_mesh = [&](const Mesh& mesh) {
    if (!counted.insert(&mesh).second) return;
    total += bytes(mesh.positions) + bytes(mesh.normals);
    const TriangleMesh& source = *mesh.source;
    if (!counted.insert(&source).second) return;
    total += bytes(source.positions) + bytes(source.triangles) + bytes(source.normals) + bytes(source.uvs);
  };
  for (const Surface& surface : surfaces) {
    if (const auto* mesh = std::get_if<Mesh>(&surface.geometry)) add_mesh(*mesh);
    if (const auto* copy = std::get_if<MeshInstance>(&surface.geometry)) add_mesh(*copy->mesh);
  }
  return total;
}

Hit Scene::intersect(const Vec3f& origin, const Vec3f& direction) const {
  const SurfaceHit<float> hit = closest_hit<float>(view_, origin, direction, no_index, true, false);
  if (!hit.valid) return {};
  return {hit.surface, hit.p, hit.normal};
}

}  // namespace photonproof
