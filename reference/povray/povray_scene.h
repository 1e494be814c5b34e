// A scene broken down into what POV-Ray has primitives for, in world space and scene units, with the choices that
// decide how each is written. Pointers are into the SceneDescription, which must outlive this.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "reference/povray/povray_mesh.h"
#include "scenes/description/description.h"

namespace photonproof {

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

using PovGeometry = std::variant<PovParallelogram, PovSphere, PovBox, PovMesh>;

struct PovSurface {
  PovGeometry geometry;
  const ShapeDescription* shape = nullptr;
  const BsdfDescription* bsdf = nullptr;
  /// Lights that enclose what they light are left to radiosity, which finds them with any ray; others are too small for
  /// its rays and become point lights.
  enum class Emission { none, spots, radiosity } emission = Emission::none;
  bool clear_back = false;  ///< the camera looks through it from behind, in place of a near clip plane
};

struct PovScene {
  const SceneDescription* description = nullptr;
  std::vector<PovSurface> surfaces;
  Vec3d center{0, 0, 0};  ///< of the bounding sphere of surfaces and point lights
  double radius = 1;      ///< of that sphere; never 0
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

/// Throws Unrepresentable: emitters that are not diffuse, rectangles of glass, surfaces, lights or the camera inside
/// glass (POV-Ray does not scale radiance by the squared index), conductors with a complex index, dielectrics whose
/// reflectance is scaled, hidden emitters; meshes that emit, that are of glass, or whose shading normals are
/// interpolated.
PovScene lower_scene(const SceneDescription& description);

}  // namespace photonproof
