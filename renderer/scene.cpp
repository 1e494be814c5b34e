#include "renderer/scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>

#include "renderer/aim_targets.h"
#include "renderer/kernels/rays.h"
#include "renderer/light_table.h"
#include "renderer/scene_frame.h"
#include "renderer/scene_shapes.h"
#include "renderer/small_scene_tables.h"

namespace photonproof {
namespace {

using Slots = std::vector<TextureSlot>;

/// The colour, or the slot of the texture that gives it.
Rgb colour(const Colour& c, std::uint32_t word, Slots& slots) {
  if (const auto* texture = std::get_if<TextureIndex>(&c)) {
    slots.push_back({texture->value, word, true});
    return Rgb(0.0f);
  }
  return Rgb(constant(c));
}

Bsdf compile(const DiffuseDescription& d, Slots& slots) { return DiffuseBsdf<float>{colour(d.reflectance, 0, slots)}; }
Bsdf compile(const ConductorDescription& d, Slots&) {
  ConductorBsdf<float> bsdf{Rgb(constant(d.specular_reflectance)), 0, {}, {}};
  if (d.ior) {
    bsdf.has_ior = 1;
    bsdf.eta = Rgb(d.ior->eta);
    bsdf.k = Rgb(d.ior->k);
  }
  return bsdf;
}
Bsdf compile(const DielectricDescription& d, Slots&) {
  return DielectricBsdf<float>{static_cast<float>(d.int_ior / d.ext_ior), Rgb(constant(d.specular_reflectance)),
                               Rgb(constant(d.specular_transmittance))};
}

template <class Other>
Bsdf compile(const Other&, Slots&) {
  throw InputError("bsdf", "is not supported yet");
}

template <class Other>
Light compile(const Other&, const Vec3d&) {
  throw InputError("emitter", "is not supported yet");
}
Light compile(const PointLightDescription& d, const Vec3d& moved) {
  return PointLight<float>{Vec3f(d.position + moved), Rgb(d.intensity)};
}

Light surface_light(const Quad& q, const Rgb& radiance) {
  return QuadLight<float>{q.corner, q.edge_u, q.edge_v, q.normal, q.area, radiance};
}
Light surface_light(const Sphere& s, const Rgb& radiance) {
  return SphereLight<float>{s.center, s.radius, s.inward ? -1.0f : 1.0f, radiance};
}

float mean_channel(const Rgb& rgb) { return (rgb.x + rgb.y + rgb.z) / 3; }

/// The variants' records one after the other, `List::stride` floats each.
template <class List>
std::vector<float> flat_records(const std::vector<typename List::Variant>& variants) {
  std::vector<float> records(variants.size() * List::stride, 0.0f);
  for (std::size_t i = 0; i < variants.size(); ++i)
    std::visit([&](const auto& record) { std::memcpy(&records[i * List::stride], &record, sizeof record); },
               variants[i]);
  return records;
}

}  // namespace

Scene::Scene(const SceneDescription& description, int width_, int height_, const SkipSwitches& skips,
             std::size_t small_limit, ScenePurpose purpose)
    : width(width_), height(height_), textures(description.textures), detail_(surfaces, textures) {
  const SceneFrame frame = scene_frame(description);
  moved_ = frame.moved;
  compile_bsdfs(description);
  SceneShapes shapes(description, textures, moved_);
  surfaces = std::move(shapes.surfaces);
  primitives_ = shapes.primitives;
  add_lights(description, shapes);
  for (const EmitterDescription& e : description.emitters)
    lights.push_back(std::visit([&](const auto& light) { return compile(light, moved_); }, e.light));

  view_.camera = compile_camera(description.sensor, width, height, moved_);
  view_.coordinate_floor = frame.coordinate_floor;

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
  light_records_ = flat_records<LightKinds>(lights);
  light_words_ = light_table(lights);
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].light != no_index)
      light_words_[surfaces[i].light].primitive = view_.small ? small_->first_primitive(i) : no_index;
  for (const Light& light : lights) {
    view_.light_kinds |= 1u << light.index();
    view_.lights_can_be_hit |= !is_delta(light);
  }
  detail_.uv_frames = std::move(shapes.uv_frames);
  compile_detail(skips);
  view_.surfaces = surface_words_.data();
  view_.bsdfs = bsdf_records_.data();
  view_.lights = light_records_.data();
  view_.light_words = light_words_.data();
  view_.light_count = static_cast<std::uint32_t>(lights.size());
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
}

Scene::~Scene() = default;

void Scene::add_lights(const SceneDescription& description, const SceneShapes& shapes) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const ShapeDescription& shape = *shapes.shape_of[i];
    if (!shape.radiance) continue;
    surfaces[i].light = static_cast<std::uint32_t>(lights.size());
    const Rgb radiance(constant(*shape.radiance));
    if (const auto* quad = std::get_if<Quad>(&surfaces[i].geometry))
      lights.push_back(surface_light(*quad, radiance));
    else if (const auto* sphere = std::get_if<Sphere>(&surfaces[i].geometry))
      lights.push_back(surface_light(*sphere, radiance));
    else
      throw InputError(description.where(shape.loc), "only rectangles, cubes and spheres can be lights yet");
    if (!std::isfinite(mean_channel(flux(lights.back()))))
      throw InputError(description.where(shape.loc), "the light's flux is too large for single precision");
  }
}

void Scene::compile_bsdfs(const SceneDescription& description) {
  detail_.tree = bsdf_tree(description.bsdfs);
  bool has_holes = false;
  for (std::size_t i = 0; i < description.bsdfs.size(); ++i) {
    const BsdfDescription& b = description.bsdfs[i];
    has_holes = has_holes || detail_.tree[i].kind == BsdfNode::Kind::mask;
    if (detail_.tree[i].kind == BsdfNode::Kind::leaf)
      bsdfs.push_back(std::visit([&](const auto& model) { return compile(model, detail_.tree[i].slots); }, b.model));
    else
      bsdfs.emplace_back();  // never looked at
  }
  detail_.nothing = static_cast<std::uint32_t>(bsdfs.size());
  if (has_holes) {
    bsdfs.emplace_back(NullBsdf<float>{});
    detail_.tree.emplace_back();
  }
  for (const Bsdf& bsdf : bsdfs) detail_.kinds.push_back(static_cast<std::uint32_t>(bsdf.index()));
}

void Scene::compile_detail(const SkipSwitches& skips) {
  for (const Surface& surface : surfaces) {
    const BsdfNode& node = detail_.tree[surface.bsdf];
    const bool plain = node.kind == BsdfNode::Kind::leaf && node.slots.empty() && !node.has_directions &&
                       !has_shading_normals(surface);
    detail_.plain.push_back(plain ? 1 : 0);
    needs_detail_ = needs_detail_ || !plain;
  }
  for (const BsdfNode& node : detail_.tree)
    view_.maps_normals |= node.kind == BsdfNode::Kind::bump || node.kind == BsdfNode::Kind::normal_map;
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
