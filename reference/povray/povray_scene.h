// A scene broken down into what POV-Ray has primitives for, in world space and scene units, with the choices that
// decide how each is written. Pointers are into the SceneDescription, which must outlive this.
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

/// The unit disc z = 0, or the side of the unit cylinder about z from z = 0 to 1, through `to_world`, which leaves it
/// round. The front is +z, or outside.
struct PovRound {
  enum class Kind { disk, cylinder } kind = Kind::disk;
  Transform to_world;
  bool inward = false;  ///< the front is the other side
  double radius() const { return length(to_world.vector({1, 0, 0})); }
  double height() const { return length(to_world.vector({0, 0, 1})); }
};

using PovGeometry = std::variant<PovParallelogram, PovSphere, PovBox, PovMesh, PovRound>;

/// How a place on a surface gives its u and v: along two edges, or as round shapes do.
enum class PovUv { flat, sphere, disk, cylinder };

struct PovSurface {
  PovGeometry geometry;
  const ShapeDescription* shape = nullptr;
  PovSides sides;
  PovOptics optics;  ///< of its front, and of its back where that is brighter
  /// From (u, v, off the surface) to world space, or from a round shape's own axes.
  Transform uv;
  PovUv uv_kind = PovUv::flat;
  /// Lights that enclose what they light are left to radiosity, which finds them with any ray; others are too small for
  /// its rays and become point lights. `picture`: seen, and nothing is there that it could light.
  enum class Emission { none, spots, radiosity, picture } emission = Emission::none;
  bool clear_back = false;  ///< the camera looks through it from behind, in place of a near clip plane
  bool endless = false;     ///< stands for a plane; counts as far as nothing else does
  bool clipped = false;     ///< by the camera's clip planes, which POV-Ray cuts it at
  /// What is behind it absorbs, per scene unit.
  std::optional<RgbD> absorption{};
};

struct PovScene {
  const SceneDescription* description = nullptr;
  std::vector<PovSurface> surfaces;
  Vec3d center{0, 0, 0};  ///< of the bounding sphere of surfaces and point lights
  double radius = 1;      ///< of that sphere; never 0
  /// The light from all around that is no surface's: constant or an envmap, which may be `baked_sky`.
  const EmitterDescription* sky = nullptr;
  std::shared_ptr<const EmitterDescription> baked_sky{};  ///< of a sunsky, without its sun
  const SunSkyDescription* sun = nullptr;
  /// The sky lights by parallel lights and is seen on a ball far away; else radiosity's rays find it.
  bool sky_as_lights = false;
  bool hides_lights = false;  ///< from the camera, which looks through them
  /// Shapes that no file spells out: those of instances.
  std::shared_ptr<std::list<ShapeDescription>> copies = std::make_shared<std::list<ShapeDescription>>();
};

double area(const PovSurface& surface);

/// The corners of what is flat, of a mesh those of its box, and how far anything reaches around them.
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

/// Where an emitter stands; nothing for those that are infinitely far.
std::optional<Vec3d> position_of(const EmitterDescription& emitter);
/// The radiance of a constant sky or the mean of an envmap.
RgbD mean_radiance(const EmitterDescription& sky);

/// Whether an emitter is constant, an envmap or a sunsky.
bool is_sky(const EmitterDescription& emitter);

/// Throws Unrepresentable for what povray_bsdf.h refuses and: emitters that are not diffuse, open surfaces
/// of glass, surfaces, lights or the camera inside glass (POV-Ray does not scale radiance by the squared index),
/// media that scatter, textures on curved shapes and on lights that light something.
PovScene lower_scene(const SceneDescription& description);

}  // namespace photonproof::inline reference_povray
