#include "reference/povray/povray_scene.h"

#include <algorithm>
#include <concepts>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "reference/povray/povray_overlap.h"
#include "reference/povray/unrepresentable.h"
#include "scenes/description/overloaded.h"

namespace photonproof {
namespace {

PovParallelogram flipped(const PovParallelogram& p) { return {p.corner, p.edge_v, p.edge_u}; }

/// The image of [-1,1]^2 under `t`. A mirrored transform turns the winding but not Mitsuba's normal (inverse
/// transpose).
PovParallelogram parallelogram(const Transform& t, bool flip) {
  const PovParallelogram p{t.point({-1, -1, 0}), t.vector({2, 0, 0}), t.vector({0, 2, 0})};
  return flip != (t.determinant() < 0) ? flipped(p) : p;
}

bool is_texture(const Colour& colour) { return std::holds_alternative<TextureIndex>(colour); }

/// What lower_shape has a case for.
template <class Kind>
concept Writable = std::same_as<Kind, SphereDescription> || std::same_as<Kind, RectangleDescription> ||
    std::same_as<Kind, CubeDescription> || std::same_as<Kind, MeshDescription>;

/// The models that povray_materials.cpp can write.
void check_model(const SceneDescription& scene, const BsdfDescription& bsdf) {
  const auto* diffuse = std::get_if<DiffuseDescription>(&bsdf.model);
  const auto* conductor = std::get_if<ConductorDescription>(&bsdf.model);
  const auto* glass = std::get_if<DielectricDescription>(&bsdf.model);
  if (!diffuse && !conductor && !glass)
    throw Unrepresentable(scene.where(bsdf.loc), "this bsdf; diffuse, conductor and dielectric can be written");
  if ((diffuse && is_texture(diffuse->reflectance)) || (conductor && is_texture(conductor->specular_reflectance)) ||
      (glass && (is_texture(glass->specular_reflectance) || is_texture(glass->specular_transmittance))))
    throw Unrepresentable(scene.where(bsdf.loc), "a texture; constant colours can be written");
  if (glass && glass->priority)
    throw Unrepresentable(scene.where(bsdf.loc), "the priority of a dielectric: POV-Ray knows none");
}

void check_kinds(const SceneDescription& scene) {
  for (const ShapeDescription& shape : scene.shapes) {
    if (!std::visit([]<class Kind>(const Kind&) { return Writable<Kind>; }, shape.geometry))
      throw Unrepresentable(scene.where(shape.loc), "this shape; spheres, rectangles, cubes and meshes can be written");
    if (shape.interior || shape.exterior) throw Unrepresentable(scene.where(shape.loc), "a participating medium");
    if (shape.radiance && is_texture(*shape.radiance))
      throw Unrepresentable(scene.where(shape.loc), "a textured area light");
  }
  for (const EmitterDescription& emitter : scene.emitters)
    if (!std::holds_alternative<PointLightDescription>(emitter.light))
      throw Unrepresentable(scene.where(emitter.loc), "this light; area and point lights can be written");
  const auto* camera = std::get_if<PerspectiveDescription>(&scene.sensor.camera);
  if (!camera || camera->principal_x != 0 || camera->principal_y != 0)
    throw Unrepresentable(scene.where(scene.sensor.loc), "this camera; a centred perspective can be written");
  if (scene.sensor.film.filter.kind != ReconstructionFilter::Kind::box || scene.sensor.film.crop)
    throw Unrepresentable(scene.where(scene.sensor.loc),
                          "a film with another filter than box, or a crop: POV-Ray's own sampling is a box");
}

void check_bsdf(const SceneDescription& scene, const BsdfDescription& bsdf) {
  check_model(scene, bsdf);
  if (const auto* conductor = std::get_if<ConductorDescription>(&bsdf.model); conductor && conductor->ior)
    throw Unrepresentable(scene.where(bsdf.loc),
                          "a conductor with a complex index of refraction: POV-Ray's Fresnel reflection is the "
                          "dielectrics'; material 'none' with specular_reflectance can be written");
  if (const auto* glass = std::get_if<DielectricDescription>(&bsdf.model);
      glass && !(glass->specular_reflectance == Colour(RgbD(1.0))))
    throw Unrepresentable(
        scene.where(bsdf.loc),
        "a dielectric with specular_reflectance other than 1: POV-Ray's conserve_energy would transmit "
        "what the surface does not reflect");
}

void check_shape(const SceneDescription& scene, const PovSurface& surface) {
  const std::string where = scene.where(surface.shape->loc);
  const bool glass = std::holds_alternative<DielectricDescription>(surface.bsdf->model);
  if (glass && std::holds_alternative<PovParallelogram>(surface.geometry))
    throw Unrepresentable(where,
                          "an open surface of dielectric: POV-Ray's index of refraction belongs to a closed body");
  if (surface.emission != PovSurface::Emission::none &&
      !std::holds_alternative<DiffuseDescription>(surface.bsdf->model))
    throw Unrepresentable(where, "an area light on a specular surface; its bsdf must be diffuse");
}

void check_mesh(const SceneDescription& scene, const ShapeDescription& shape) {
  const std::string where = scene.where(shape.loc);
  if (shape.radiance && max_component(constant(*shape.radiance)) > 0)
    throw Unrepresentable(where, "an area light on a triangle mesh: only rectangles, cubes and spheres become points");
  if (std::holds_alternative<DielectricDescription>(scene.bsdfs[shape.bsdf.value].model))
    throw Unrepresentable(where,
                          "a triangle mesh of dielectric: POV-Ray's index of refraction belongs to a closed body, and "
                          "nothing says that the mesh is one");
  if (!std::get<MeshDescription>(shape.geometry).face_normals)
    throw Unrepresentable(
        where, "a triangle mesh with interpolated shading normals; one with face_normals true can be written");
}

void add_surface(PovScene& scene, PovSurface surface, const PovGeometry& geometry) {
  surface.geometry = geometry;
  check_shape(*scene.description, surface);
  scene.surfaces.push_back(surface);
}

void lower_shape(PovScene& scene, const ShapeDescription& shape) {
  PovSurface surface;
  surface.shape = &shape;
  surface.bsdf = &scene.description->bsdfs[shape.bsdf.value];
  const bool emits = shape.radiance && max_component(constant(*shape.radiance)) > 0;
  if (emits) surface.emission = PovSurface::Emission::spots;
  const bool closed = !std::holds_alternative<RectangleDescription>(shape.geometry);
  if (emits && closed && shape.flip_normals) surface.emission = PovSurface::Emission::radiosity;

  const auto add_box = [&](const PovBox& box) {
    const bool glass = std::holds_alternative<DielectricDescription>(surface.bsdf->model);
    if (glass || (!emits && !shape.flip_normals)) return add_surface(scene, surface, box);
    for (const PovParallelogram& face : box.faces()) add_surface(scene, surface, face);
  };
  std::visit(Overloaded{[&](const SphereDescription& sphere) {
                          const double scale = std::cbrt(std::abs(shape.to_world.determinant()));
                          add_surface(scene, surface,
                                      PovSphere{shape.to_world.point(sphere.center), sphere.radius * scale,
                                                shape.flip_normals});
                        },
                        [&](const MeshDescription&) {
                          check_mesh(*scene.description, shape);
                          add_surface(scene, surface, place_mesh(shape, scene.surfaces.size()));
                        },
                        [&](const RectangleDescription&) {
                          add_surface(scene, surface, parallelogram(shape.to_world, shape.flip_normals));
                        },
                        [&](const CubeDescription&) {
                          add_box({shape.to_world, shape.flip_normals});
                        },
                        []<class Kind>(const Kind&) {
                          static_assert(!Writable<Kind>);
                          throw std::logic_error("check_kinds lets no such shape through");
                        }},
             shape.geometry);
}

/// A ball around the centre of the axis-aligned box of everything.
void bound(PovScene& scene) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3d low(inf), high(-inf);
  const auto add = [&](const Vec3d& p, double reach) {
    low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach), std::min(low.z, p.z - reach)};
    high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach), std::max(high.z, p.z + reach)};
  };
  for (const PovSurface& surface : scene.surfaces) {
    const PovExtent of = extent(surface);
    for (const Vec3d& p : of.points) add(p, of.reach);
  }
  for (const EmitterDescription& emitter : scene.description->emitters)
    add(std::get<PointLightDescription>(emitter.light).position, 0);
  if (low.x > high.x) return;
  scene.center = (low + high) * 0.5;
  const double radius = length(high - low) * 0.5;
  if (radius > 0) scene.radius = radius;
}

bool hides_emitters(const IntegratorDescription& integrator) {
  return std::visit([](const auto& method) { return method.hide_emitters; }, integrator.method);
}

}  // namespace

std::array<Vec3d, 4> PovParallelogram::vertices() const {
  return {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
}
Vec3d PovParallelogram::normal() const { return normalize(cross(edge_u, edge_v)); }
double PovParallelogram::area() const { return length(cross(edge_u, edge_v)); }

std::array<PovParallelogram, 6> PovBox::faces() const {
  const Vec3d x = to_world.vector({1, 0, 0});
  const Vec3d y = to_world.vector({0, 1, 0});
  const Vec3d z = to_world.vector({0, 0, 1});
  const Vec3d c = to_world.point({0, 0, 0});
  // Seen from outside, each winds counter-clockwise as long as (x, y, z) is right-handed.
  const auto face = [&](const Vec3d& n, const Vec3d& u, const Vec3d& v) {
    const PovParallelogram p{c + n - u - v, u * 2.0, v * 2.0};
    return inward != (to_world.determinant() < 0) ? flipped(p) : p;
  };
  return {face(x, y, z), face(-x, z, y), face(y, z, x), face(-y, x, z), face(z, x, y), face(-z, y, x)};
}

double area(const PovSurface& surface) {
  const auto of_box = [](const PovBox& box) {
    double sum = 0;
    for (const PovParallelogram& side : box.faces()) sum += side.area();
    return sum;
  };
  return std::visit(
      Overloaded{[](const PovSphere& sphere) { return 4 * std::numbers::pi * sphere.radius * sphere.radius; },
                 [](const PovParallelogram& face) { return face.area(); },
                 [](const PovMesh& mesh) { return mesh.area; }, of_box},
      surface.geometry);
}

PovExtent extent(const PovSurface& surface) {
  PovExtent found;
  const auto add_all = [&](const auto& corners) {
    found.points.insert(found.points.end(), corners.begin(), corners.end());
  };
  std::visit(Overloaded{[&](const PovSphere& sphere) {
                          found = {{sphere.center}, sphere.radius};
                        },
                        [&](const PovParallelogram& face) { add_all(face.vertices()); },
                        [&](const PovMesh& mesh) { add_all(mesh.box_corners()); },
                        [&](const PovBox& box) {
                          for (const PovParallelogram& side : box.faces()) add_all(side.vertices());
                        }},
             surface.geometry);
  return found;
}

bool is_diffuse(const PovSurface& surface) {
  const auto* diffuse = std::get_if<DiffuseDescription>(&surface.bsdf->model);
  return diffuse && max_component(constant(diffuse->reflectance)) > 0;
}

bool is_specular(const PovSurface& surface) { return !std::holds_alternative<DiffuseDescription>(surface.bsdf->model); }

PovScene lower_scene(const SceneDescription& description) {
  PovScene scene;
  scene.description = &description;
  check_kinds(description);
  for (const ShapeDescription& shape : description.shapes) {
    check_bsdf(description, description.bsdfs[shape.bsdf.value]);
    lower_shape(scene, shape);
    if (shape.radiance && hides_emitters(description.integrator))
      throw Unrepresentable(description.where(description.integrator.loc),
                            "hide_emitters: POV-Ray cannot hide a light from the camera and show it in glass");
  }
  bound(scene);
  refuse_overlaps_with_glass(scene);
  return scene;
}

}  // namespace photonproof
