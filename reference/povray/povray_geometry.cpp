#include "reference/povray/povray_geometry.h"

#include <stdexcept>

#include "reference/povray/povray_materials.h"
#include "scenes/description/overloaded.h"
#include "scenes/text/text_numbers.h"

namespace photonproof {
namespace {

// A ray through the common edge of two exactly adjoining polygons can miss both; walls that reach this far past their
// edges (as a fraction of their size) leave no gap, and change no picture at double precision's 1e-16.
constexpr double kOverlap = 1e-6;

// How far twins lie behind what they are twins of, in POV-Ray's lengths: what is seen first is not the twin, and shadow
// rays to it still end at the surface (they forgive 1e-3 along the ray). Below what kOverlap closes at edges.
constexpr double kBehind = 2e-5;

/// The opening of an object: its type and coordinates.
std::string shape_sdl(const PovParallelogram& face, double scale) {
  const Vec3d u = face.edge_u * (scale * kOverlap);
  const Vec3d v = face.edge_v * (scale * kOverlap);
  const Vec3d c = face.corner * scale - u - v;
  const Vec3d to_u = face.edge_u * scale + u * 2.0;
  const Vec3d to_v = face.edge_v * scale + v * 2.0;
  // Counter-clockwise seen from the front: POV-Ray takes the other side for the interior.
  return "polygon{5, " + sdl_vector(c) + "," + sdl_vector(c + to_u) + "," + sdl_vector(c + to_u + to_v) + "," +
         sdl_vector(c + to_v) + "," + sdl_vector(c);
}

std::string shape_sdl(const PovSphere& sphere, double scale) {
  return "sphere{" + sdl_vector(sphere.center * scale) + ", " + format_number(sphere.radius * scale) +
         (sphere.inward ? " inverse" : "");
}

std::string shape_sdl(const PovBox& box, double scale) {
  // POV-Ray multiplies row vectors: the rows of its matrix are the images of the axes.
  std::string matrix;
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    const Vec3d image = box.to_world.vector(axis) * scale;
    matrix += format_number(image.x) + "," + format_number(image.y) + "," + format_number(image.z) + ", ";
  }
  const Vec3d origin = box.to_world.point({0, 0, 0}) * scale;
  matrix += format_number(origin.x) + "," + format_number(origin.y) + "," + format_number(origin.z);
  return std::string("box{-1, 1") + (box.inward ? " inverse" : "") + " matrix<" + matrix + ">";
}

/// The mesh itself is declared before.
std::string shape_sdl(const PovMesh& mesh, double) { return "object{Mesh_" + std::to_string(mesh.number); }

std::string kind(const PovSurface& surface) {
  const bool rectangle = std::holds_alternative<RectangleDescription>(surface.shape->geometry);
  return std::visit(Overloaded{[](const PovMesh& mesh) {
                                 return "ply as a mesh2 of " + std::to_string(mesh.mesh->triangles.size()) +
                                        " flat triangles, in world space and single precision";
                               },
                               [](const PovSphere&) -> std::string { return "sphere"; },
                               [](const PovBox&) -> std::string { return "cube as a box"; },
                               [&](const PovParallelogram&) -> std::string {
                                 return rectangle ? "rectangle as a polygon" : "side of a cube as a polygon";
                               }},
                    surface.geometry);
}

/// Texture of a light's front that shows both what it emits and what it reflects. POV-Ray multiplies emission by the
/// pigment, so it is divided by it here; a channel that reflects nothing gets a pigment too small to be seen.
std::string emitter_texture(const RgbD& reflectance, const RgbD& radiance) {
  const bool black = max_component(reflectance) <= 0;
  const double least = 1e-9;
  const RgbD pigment =
      black ? RgbD(1.0)
            : RgbD{std::max(reflectance.x, least), std::max(reflectance.y, least), std::max(reflectance.z, least)};
  return "texture{pigment{" + sdl_rgb(pigment) + "} finish{ambient 0 diffuse " + (black ? "0" : "1/Brightness") +
         " emission " + sdl_rgb(radiance / pigment) + "}}";
}

std::string photon_target(const PovSurface& surface) {
  const bool glass = std::holds_alternative<DielectricDescription>(surface.bsdf->model);
  return std::string(" photons{target reflection on refraction ") + (glass ? "on" : "off") + " collect off}";
}

std::string back_of(const PovSurface& surface) {
  return surface.clear_back ? " interior_texture{Clear} interior{ior 1}" : " interior_texture{Black}";
}

std::string outline(const PovSurface& surface, const PovPlan& plan) {
  return std::visit([&](const auto& geometry) { return shape_sdl(geometry, plan.scale); }, surface.geometry);
}

PovParallelogram behind(PovParallelogram face, double distance) {
  face.corner = face.corner - face.normal() * distance;
  return face;
}
PovSphere behind(PovSphere sphere, double distance) {
  sphere.radius += sphere.inward ? distance : -distance;
  return sphere;
}
PovBox behind(PovBox box, double distance) {
  const auto by = [&](const Vec3d& axis) {
    return 1 + (box.inward ? distance : -distance) / length(box.to_world.vector(axis));
  };
  box.to_world = box.to_world * Transform::scale({by({1, 0, 0}), by({0, 1, 0}), by({0, 0, 1})});
  return box;
}
PovMesh behind(const PovMesh&, double) { throw std::logic_error("has_twin says no"); }

/// POV-Ray shows no photons on what is `no_image`, not even to radiosity's rays: where there are photons, twins are
/// hidden from the camera by what they are twins of.
bool hides_behind(const PovPlan& plan) { return plan.photons; }

std::string plain_texture(const PovScene& scene, const PovSurface& surface) {
  return " texture{Bsdf_" + std::to_string(bsdf_number(scene, surface)) + "}";
}

void write_surface(const PovScene& scene, const PovSurface& surface, const PovPlan& plan, SdlWriter& out) {
  std::string object = outline(surface, plan);
  if (surface.emission != PovSurface::Emission::none) {
    const bool surrounding = surface.emission == PovSurface::Emission::radiosity;
    out.explain(surrounding ? "  emits inwards: radiosity's rays find it, so it needs no light_source"
                            : "  emits: this body is what is seen of the light; its light_sources are what lights");
    object += " " + emitter_texture(constant(std::get<DiffuseDescription>(surface.bsdf->model).reflectance),
                                    constant(*surface.shape->radiance) * (plan.shows_lamps ? plan.exposure : 0));
  } else {
    object += plain_texture(scene, surface);
  }
  if (std::holds_alternative<DielectricDescription>(surface.bsdf->model)) {
    object += " interior{Interior_" + std::to_string(bsdf_number(scene, surface)) + "}";
  } else {
    object += back_of(surface);
  }
  if (surface.clear_back)
    out.explain("  clear from behind, where only the camera is: the near clip plane cuts it out of the picture");
  if (plan.photons && is_specular(surface)) object += photon_target(surface);
  // A light that reflects nothing has no twin, yet radiosity's rays must not see it: its light_sources are counted.
  const bool counted = surface.emission == PovSurface::Emission::spots;
  if (plan.radiosity && (counted || has_twin(surface, plan))) object += " no_radiosity";
  object += "}";
  out.line(object);
}

}  // namespace

void write_surfaces(const PovScene& scene, const PovPlan& plan, SdlWriter& out) {
  for (const PovSurface& surface : scene.surfaces) {
    out.explain("shape '" + surface.shape->id + "' of " + scene.description->where(surface.shape->loc) + ": " +
                kind(surface));
    if (const auto* mesh = std::get_if<PovMesh>(&surface.geometry))
      out.later([mesh = *mesh, scale = plan.scale](std::ostream& text) { write_mesh_declaration(mesh, scale, text); });
    write_surface(scene, surface, plan, out);
  }
}

bool has_twin(const PovSurface& surface, const PovPlan& plan) {
  if (hides_behind(plan) && std::holds_alternative<PovMesh>(surface.geometry)) return false;  // it has no behind
  return plan.radiosity && plan.point_lights && surface.emission != PovSurface::Emission::radiosity &&
         is_diffuse(surface);
}

void write_twins(const PovScene& scene, const PovPlan& plan, SdlWriter& out) {
  for (PovSurface surface : scene.surfaces) {
    if (!has_twin(surface, plan)) continue;
    if (hides_behind(plan))
      std::visit([&](auto& geometry) { geometry = behind(geometry, kBehind / plan.scale); }, surface.geometry);
    // Mirrors must show a light's body and not its dark twin; of other surfaces either will do.
    const bool emits = surface.emission != PovSurface::Emission::none;
    out.line(outline(surface, plan) + plain_texture(scene, surface) + back_of(surface) +
             (hides_behind(plan) ? "" : " no_image") + " no_shadow" + (emits ? " no_reflection}" : "}"));
  }
}

}  // namespace photonproof
