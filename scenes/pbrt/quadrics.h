// pbrt's spheres, disks and cylinders, whole or in part, as triangles with normals and texture coordinates.
#pragma once

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_pbrt {

struct PbrtQuadric {
  enum class Kind { sphere, disk, cylinder } kind = Kind::sphere;
  double radius = 1;
  double inner = 0;             ///< inner radius of a disk
  double bottom = -1, top = 1;  ///< zmin and zmax; of a disk both are its height
  double sweep_degrees = 360;   ///< phimax
  bool is_whole() const;
  friend auto operator<=>(const PbrtQuadric&, const PbrtQuadric&) = default;
};

/// Normals outward, +z of a disk. Texture coordinates are (u, 1 - v) of pbrt's.
TriangleMesh triangles_of(const PbrtQuadric& quadric);

}  // namespace photonproof::inline scenes_pbrt
