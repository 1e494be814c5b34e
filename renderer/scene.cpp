#include "renderer/scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "renderer/aim_targets.h"
#include "renderer/kernels/rays.h"
#include "renderer/light_table.h"
#include "renderer/scene_frame.h"
#include "renderer/small_scene_tables.h"

namespace photonproof {
namespace {

Bsdf compile(const DiffuseDescription& d) { return DiffuseBsdf<float>{Rgb(constant(d.reflectance))}; }
Bsdf compile(const ConductorDescription& d) {
  ConductorBsdf<float> bsdf{Rgb(constant(d.specular_reflectance)), 0, {}, {}};
  if (d.ior) {
    bsdf.has_ior = 1;
    bsdf.eta = Rgb(d.ior->eta);
    bsdf.k = Rgb(d.ior->k);
  }
  return bsdf;
}
Bsdf compile(const DielectricDescription& d) {
  return DielectricBsdf<float>{static_cast<float>(d.int_ior / d.ext_ior), Rgb(constant(d.specular_reflectance)),
                               Rgb(constant(d.specular_transmittance))};
}

template <class Other>
Bsdf compile(const Other&) {
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

/// Local-to-face transforms of the cube's six sides: each maps [-1,1]^2 (normal +z) onto one side, normal outward.
std::array<Transform, 6> cube_faces() {
  const Vec3d x{1, 0, 0}, y{0, 1, 0};
  const Transform top = Transform::translate({0, 0, 1});
  return {top,
          Transform::rotate(y, 180) * top,
          Transform::rotate(y, 90) * top,
          Transform::rotate(y, -90) * top,
          Transform::rotate(x, 90) * top,
          Transform::rotate(x, -90) * top};
}

/// Estimators divide by areas and normalise by them: both must stay finite with room to spare.
bool has_usable_size(const Geometry& geometry) {
  const auto usable = [](float area) { return area > 1e-30f && area < 1e30f; };
  if (const auto* quad = std::get_if<Quad>(&geometry)) return usable(quad->area);
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) return usable(sphere->area());
  return true;
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
             std::size_t small_limit)
    : width(width_), height(height_) {
  const SceneFrame frame = scene_frame(description);
  moved_ = frame.moved;
  media = compile_media(description);
  for (const BsdfDescription& b : description.bsdfs)
    bsdfs.push_back(std::visit([](const auto& model) { return compile(model); }, b.model));
  for (const ShapeDescription& shape : description.shapes) add_shape(description, shape);
  for (const EmitterDescription& e : description.emitters)
    lights.push_back(std::visit([&](const auto& light) { return compile(light, moved_); }, e.light));

  view_.camera = compile_camera(description.sensor, width, height, moved_);
  view_.coordinate_floor = frame.coordinate_floor;

  small_ = primitives_ <= small_limit && skips.on(Skip::bvh) ? std::make_unique<SmallSceneTables>(surfaces) : nullptr;
  if (small_ == nullptr) tracer_ = std::make_unique<Tracer>(surfaces);
  view_.small = small_ != nullptr;
  if (small_ != nullptr) view_.primitives = small_->view();
  view_.tracer = tracer_.get();

  for (const Surface& surface : surfaces) {
    const auto kind = static_cast<std::uint32_t>(bsdfs[surface.bsdf].index());
    surface_words_.push_back({kind, surface.bsdf, surface.light});
    view_.bsdf_kinds |= 1u << kind;
  }
  if (surface_words_.empty()) surface_words_.push_back({0, 0, no_index});  // what rays that miss gather
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
  view_.surfaces = surface_words_.data();
  view_.bsdfs = bsdf_records_.data();
  view_.lights = light_records_.data();
  view_.light_words = light_words_.data();
  view_.light_count = static_cast<std::uint32_t>(lights.size());
  aim_targets_ = aim_targets(surfaces, bsdfs);
  view_.aim_targets = aim_targets_.data();
  view_.aim_target_count = static_cast<std::uint32_t>(aim_targets_.size());
  view_.one_light = lights.size() == 1 && skips.on(Skip::light_choice);
  view_.one_bsdf_kind = std::has_single_bit(view_.bsdf_kinds) && skips.on(Skip::bsdf_groups);
  view_.dark_shadow_rays = !skips.on(Skip::shadow_rays);
}

Scene::~Scene() = default;

void Scene::add_shape(const SceneDescription& description, const ShapeDescription& shape) {
  const std::size_t first = surfaces.size();
  const Transform to_world = Transform::translate(moved_) * shape.to_world;
  if (const auto* sphere = std::get_if<SphereDescription>(&shape.geometry)) {
    add_surface(Sphere{Vec3f(to_world.point(sphere->center)),
                       static_cast<float>(sphere->radius * shape.to_world.similarity_scale()), shape.flip_normals},
                shape);
  } else if (const auto* ply = std::get_if<MeshDescription>(&shape.geometry)) {
    add_mesh(description, shape, *ply, to_world);
    return;
  } else if (std::holds_alternative<RectangleDescription>(shape.geometry)) {
    add_quad(shape, to_world);
  } else {
    for (const Transform& face : cube_faces()) add_quad(shape, to_world * face);
  }
  primitives_ += surfaces.size() - first;
  for (auto surface = surfaces.begin() + static_cast<std::ptrdiff_t>(first); surface != surfaces.end(); ++surface)
    if (!has_usable_size(surface->geometry))
      throw InputError(description.where(shape.loc), "the shape's area is outside what single precision can hold");
  if (shape.radiance && !lights.empty() && !std::isfinite(mean_channel(flux(lights.back()))))
    throw InputError(description.where(shape.loc), "the light's flux is too large for single precision");
}

void Scene::add_surface(Geometry geometry, const ShapeDescription& shape) {
  Surface surface{std::move(geometry), shape.bsdf.value};
  if (shape.interior) surface.interior = shape.interior->value;
  if (shape.exterior) surface.exterior = shape.exterior->value;
  if (shape.radiance) {
    surface.light = static_cast<std::uint32_t>(lights.size());
    const Rgb radiance(constant(*shape.radiance));
    if (const auto* quad = std::get_if<Quad>(&surface.geometry)) lights.push_back(surface_light(*quad, radiance));
    if (const auto* sphere = std::get_if<Sphere>(&surface.geometry)) lights.push_back(surface_light(*sphere, radiance));
  }
  surfaces.push_back(std::move(surface));
}

void Scene::add_quad(const ShapeDescription& shape, const Transform& face_to_world) {
  const Vec3d corner = face_to_world.point({-1, -1, 0});
  const Vec3d edge_u = face_to_world.vector({2, 0, 0});
  const Vec3d edge_v = face_to_world.vector({0, 2, 0});
  const Vec3d n = cross(edge_u, edge_v);
  const double area = length(n);
  // A mirrored transform turns the winding round but not the side Mitsuba's normal (inverse transpose) points to.
  const bool mirrored = shape.to_world.determinant() < 0;
  const Vec3d normal = n / area * (shape.flip_normals != mirrored ? -1.0 : 1.0);
  add_surface(Quad{Vec3f(corner), Vec3f(edge_u), Vec3f(edge_v), Vec3f(normal), static_cast<float>(area)}, shape);
}

void Scene::add_mesh(const SceneDescription& description, const ShapeDescription& shape, const MeshDescription& ply,
                     const Transform& to_world) {
  const std::string where = description.where(shape.loc);
  if (!ply.face_normals) throw InputError(where, "smooth normals are not supported yet: set face_normals to true");
  if (shape.radiance) throw InputError(where, "a mesh cannot be a light yet");
  const TriangleMesh& source = *ply.mesh;
  Mesh mesh;
  mesh.positions.reserve(source.positions.size() + 1);
  for (const Vec3f& p : source.positions) mesh.positions.push_back(Vec3f(to_world.point(Vec3d(p))));
  mesh.positions.emplace_back();
  mesh.source = ply.mesh;
  mesh.inward = shape.flip_normals;  // as Mitsuba, which lets a mirroring transform turn a mesh over
  primitives_ += mesh.triangle_count();
  add_surface(std::move(mesh), shape);
}

std::size_t Scene::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(surfaces) + bytes(bsdfs) + bytes(lights) + bytes(surface_words_) + bytes(light_words_) +
                      bytes(bsdf_records_) + bytes(light_records_);
  for (const Surface& surface : surfaces)
    if (const auto* mesh = std::get_if<Mesh>(&surface.geometry))
      total += bytes(mesh->positions) + bytes(mesh->source->positions) + bytes(mesh->source->triangles);
  return total;
}

Hit Scene::intersect(const Vec3f& origin, const Vec3f& direction) const {
  const SurfaceHit<float> hit = closest_hit<float>(view_, origin, direction, no_index, true, false);
  if (!hit.valid) return {};
  return {hit.surface, hit.p, hit.normal};
}

}  // namespace photonproof
