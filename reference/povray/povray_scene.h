// A scene broken down into POV-Ray's primitives, in world space and scene units, with the choices that decide how each
// is written. Pointers are into the SceneDescription, which must outlive this.
#pragma once

#include <array>
#include <list>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "reference/povray/povray_bsdf.h"
#include "reference/povray/povray_mesh.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_povray {

/// corner + s u + t v; cross(edge_u, edge_v) points to the front, the side a one-sided surface reflects and emits on.
struct PovParallelogram {
  Vec3d corner, edge_u, edge_v;
  std::array<Vec3d, 4> vertices() const;
  Vec3d normal() const;  ///< unit length
  double area() const;
};
struct PovSphere {
  Vec3d center;
  double radius = 1;
  bool inward = false;  ///< the front is the inside
};
/// [-1,1]^3 through `to_world`.
struct PovBox {
  Transform to_world;
  bool inward = false;
  std::array<PovParallelogram, 6> faces() const;
};

/// The unit disc z = 0, or the side of the unit cylinder about z from z = 0 to 1, mapped by `to_world`, which keeps it
/// round. The front is +z, or outside.
struct PovRound {
  enum class Kind { disk, cylinder } kind = Kind::disk;
  Transform to_world;
  bool inward = false;  ///< the front is the other side
  double radius() const { return length(to_world.vector({1, 0, 0})); }
  double height() const { return length(to_world.vector({0, 0, 1})); }
};

using PovGeometry = std::variant<PovParallelogram, PovSphere, PovBox, PovMesh, PovRound>;

/// How a place on a surface determines u and v: along two edges, or as round shapes do.
enum class PovUv { flat, sphere, disk, cylinder };

struct PovSurface {
  PovGeometry geometry;
  const ShapeDescription* shape = nullptr;
  PovSides sides;
  PovOptics optics;  ///< of its front, or of its back where that is brighter
  /// From (u, v, off the surface) to world space, or from a round shape's own axes.
  Transform uv;
  PovUv uv_kind = PovUv::flat;
  /// Radiosity's rays find lights that enclose the surfaces they light. Other lights are too small for its rays and
  /// become point lights. `picture`: visible, with no surface that it could light.
  enum class Emission { none, spots, radiosity, picture } emission = Emission::none;
  bool clear_back = false;  ///< The camera looks through it from behind, in place of a near clip plane.
  bool endless = false;     ///< Stands for a plane; counts only as far as other surfaces reach.
  bool clipped = false;     ///< POV-Ray cuts it at the camera's clip planes.
  /// Absorption of the medium behind it, per scene unit.
  std::optional<RgbD> absorption{};
};

struct PovScene {
  const SceneDescription* description = nullptr;
  std::vector<PovSurface> surfaces;
  Vec3d center{0, 0, 0};  ///< Centre of the bounding sphere of surfaces and point lights.
  double radius = 1;      ///< Radius of that sphere; never 0.
  /// Environment light, constant or an envmap, which may be `baked_sky`.
  const EmitterDescription* sky = nullptr;
  std::shared_ptr<const EmitterDescription> baked_sky{};  ///< a sunsky's sky without its sun
  const SunSkyDescription* sun = nullptr;
  /// The sky becomes parallel lights and a visible distant ball; else radiosity's rays find it.
  bool sky_as_lights = false;
  bool hides_lights = false;  ///< the camera looks through lights
  /// Shapes that no file states explicitly: those of instances.
  std::shared_ptr<std::list<ShapeDescription>> copies = std::make_shared<std::list<ShapeDescription>>();
};

double area(const PovSurface& surface);

/// The corners of a flat surface or of a mesh's box, and how far the surface reaches around them.
struct PovExtent {
  std::vector<Vec3d> points;
  double reach = 0;
};
PovExtent extent(const PovSurface& surface);

/// A diffuse surface that reflects anything.
bool is_diffuse(const PovSurface& surface);
/// A mirror or glass.
bool is_specular(const PovSurface& surface);
/// Glass with an inside.
bool is_glass(const PovSurface& surface);

/// Where an emitter stands; empty for emitters that are infinitely far.
std::optional<Vec3d> position_of(const EmitterDescription& emitter);
/// The radiance of a constant sky or the mean of an envmap.
RgbD mean_radiance(const EmitterDescription& sky);

/// Whether an emitter is constant, an envmap or a sunsky.
bool is_sky(const EmitterDescription& emitter);

/// Throws Unrepresentable for everything that povray_bsdf.h refuses. It also refuses emitters that are not diffuse,
/// open surfaces of glass, media that scatter, and textures on curved shapes and on lights that light something.
/// Surfaces, lights and the camera must not be inside glass, as POV-Ray does not scale radiance by the squared index.
PovScene lower_scene(const SceneDescription& description);

}  // namespace photonproof::inline reference_povray
