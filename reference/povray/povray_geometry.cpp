#include "reference/povray/povray_geometry.h"

#include <stdexcept>

#include "reference/povray/povray_lights.h"
#include "reference/povray/povray_materials.h"
#include "reference/povray/povray_paths.h"
#include "reference/povray/povray_pigments.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_povray {
namespace {

// A ray through the common edge of two exactly adjoining polygons can miss both. Walls that reach this far past their
// edges (as a fraction of their size) leave no gap, and do not change the image beyond double precision's 1e-16.
constexpr double kOverlap = 1e-6;

// Distance of a twin behind its surface, in POV-Ray's lengths. The camera then sees the surface first, and shadow rays
// to the twin still end at the surface (they tolerate 1e-3 along the ray). It is smaller than the gap kOverlap closes.
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
  return std::string("box{-1, 1") + (box.inward ? " inverse" : "") + matrix_sdl(box.to_world, scale);
}

std::string shape_sdl(const PovRound& round, double scale) {
  const bool mirrored = round.to_world.determinant() < 0;  // turns no normal of Mitsuba's, and none of a cylinder
  if (round.kind == PovRound::Kind::cylinder)
    return std::string("cylinder{0, z, 1 open") + (round.inward ? " inverse" : "") + matrix_sdl(round.to_world, scale);
  return std::string("disc{0, z, 1") + (round.inward != mirrored ? " inverse" : "") + matrix_sdl(round.to_world, scale);
}

/// The mesh itself is declared before.
std::string shape_sdl(const PovMesh& mesh, double) { return "object{Mesh_" + std::to_string(mesh.number); }

std::string kind(const PovSurface& surface) {
  const bool rectangle = std::holds_alternative<RectangleDescription>(surface.shape->geometry);
  return std::visit(Overloaded{[](const PovMesh& mesh) {
                                 return "a mesh2 of " + std::to_string(mesh.mesh->triangles.size()) +
                                        (mesh.smooth ? " smooth" : " flat") +
                                        " triangles, in world space and single precision";
                               },
                               [](const PovSphere&) -> std::string { return "sphere"; },
                               [](const PovRound& round) -> std::string {
                                 return round.kind == PovRound::Kind::disk ? "disk as a disc" : "cylinder without caps";
                               },
                               [](const PovBox&) -> std::string { return "cube as a box"; },
                               [&](const PovParallelogram&) -> std::string {
                                 if (surface.endless) return "plane as a polygon that ends far away";
                                 return rectangle ? "rectangle as a polygon" : "side of a cube as a polygon";
                               }},
                    surface.geometry);
}

std::string photon_target(const PovSurface& surface) {
  return std::string(" photons{target reflection on refraction ") + (is_glass(surface) ? "on" : "off") +
         (is_diffuse(surface) ? "}" : " collect off}");
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
PovRound behind(PovRound round, double distance) {
  const double along = round.inward ? -distance : distance;
  if (round.kind == PovRound::Kind::disk) {
    const Vec3d n = normalize(cross(round.to_world.vector({1, 0, 0}), round.to_world.vector({0, 1, 0})));
    const double side = round.to_world.determinant() < 0 ? -along : along;
    round.to_world = Transform::translate(n * -side) * round.to_world;
  } else {
    const double by = 1 - along / round.radius();
    round.to_world = round.to_world * Transform::scale({by, by, 1});
  }
  return round;
}
PovMesh behind(const PovMesh&, double) { throw std::logic_error("has_twin says no"); }

/// POV-Ray shows no photons on `no_image` objects, not even to radiosity's rays. With photons the originals therefore
/// hide their twins from the camera.
bool hides_behind(const PovPlan& plan) { return plan.photons; }

/// A light that the camera looks through: it shines in mirrors and for radiosity's rays.
void write_hidden_light(const PovScene& scene, const PovSurface& surface, const PovPlan& plan, SdlWriter& out) {
  out.explain("  hide_emitters: the camera looks through it, mirrors see it shine");
  out.line(outline(surface, plan) + light_texture(scene, surface, plan) + back_of(scene, surface, plan) + " no_image" +
           (plan.radiosity ? " no_radiosity" : "") + "}");
}

void explain_light(const PovSurface& surface, SdlWriter& out) {
  switch (surface.emission) {
    case PovSurface::Emission::none:
      return;
    case PovSurface::Emission::radiosity:
      return out.explain(
          "  emits from all around what it lights: radiosity's rays find it, so it needs no light_source");
    case PovSurface::Emission::picture:
      return out.explain("  emits, and lights nothing that reflects: what is seen of it is all there is");
    case PovSurface::Emission::spots:
      return out.explain("  emits: this body is what is seen of the light; its light_sources are what lights");
  }
}

void write_surface(const PovScene& scene, const PovSurface& surface, const PovPlan& plan, const std::string& clip,
                   SdlWriter& out) {
  std::string object = outline(surface, plan);
  explain_light(surface, out);
  if (surface.emission == PovSurface::Emission::none) {
    object += material_of(scene, surface, plan);
  } else if (scene.hides_lights) {
    return write_hidden_light(scene, surface, plan, out);
  } else {
    object += light_texture(scene, surface, plan) + back_of(scene, surface, plan);
  }
  if (surface.clear_back)
    out.explain("  clear from behind, where only the camera is: the near clip plane cuts it out of the picture");
  if (surface.clipped) {
    out.explain("  cut by the clip planes: nothing is lit, so that only the picture changes");
    object += clip;
  }
  if (plan.photons && is_specular(surface)) object += photon_target(surface);
  // Radiosity's rays must not see the emission of a light that light_sources already count. They see its twin, which
  // hides everything behind it.
  const bool counted = surface.emission == PovSurface::Emission::spots;
  if (plan.radiosity && (counted || has_twin(surface, plan))) object += " no_radiosity";
  if (counted && std::holds_alternative<PovSphere>(surface.geometry) && has_many_lights(scene)) object += " no_shadow";
  object += "}";
  out.line(object);
}

}  // namespace

void write_surfaces(const PovScene& scene, const PovPlan& plan, const std::string& clip, SdlWriter& out) {
  for (const PovSurface& surface : scene.surfaces) {
    out.explain("shape '" + surface.shape->id + "' of " + scene.description->where(surface.shape->loc) + ": " +
                kind(surface));
    if (const auto* mesh = std::get_if<PovMesh>(&surface.geometry))
      out.later([mesh = *mesh, scale = plan.scale](std::ostream& text) { write_mesh_declaration(mesh, scale, text); });
    write_surface(scene, surface, plan, clip, out);
  }
}

bool has_twin(const PovSurface& surface, const PovPlan& plan) {
  if (hides_behind(plan) && std::holds_alternative<PovMesh>(surface.geometry)) return false;  // it has no behind
  return plan.radiosity && plan.point_lights && surface.emission != PovSurface::Emission::radiosity &&
         (is_diffuse(surface) || surface.emission == PovSurface::Emission::spots);
}

void write_twins(const PovScene& scene, const PovPlan& plan, SdlWriter& out) {
  for (PovSurface surface : scene.surfaces) {
    if (!has_twin(surface, plan)) continue;
    if (hides_behind(plan))
      std::visit([&](auto& geometry) { geometry = behind(geometry, kBehind / plan.scale); }, surface.geometry);
    // Mirrors must show a light's body and not its dark twin; of other surfaces either will do.
    const bool emits = surface.emission != PovSurface::Emission::none;
    const std::string material =
        plan.paths ? mortal_material_of(scene, surface, plan) : material_of(scene, surface, plan);
    const bool hidden = !hides_behind(plan) || (emits && scene.hides_lights);
    out.line(outline(surface, plan) + material + (hidden ? " no_image" : "") + " no_shadow" +
             (emits ? " no_reflection}" : "}"));
  }
}

}  // namespace photonproof::inline reference_povray
