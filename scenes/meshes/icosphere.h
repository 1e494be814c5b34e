// The unit sphere as triangles of nearly equal size: an icosahedron whose triangles are repeatedly cut into four.
#pragma once

#include <vector>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_meshes {

struct Icosphere {
  std::vector<Vec3d> directions;                  ///< unit length, 10 * 4^level + 2 of them
  std::vector<TriangleMesh::Triangle> triangles;  ///< facing outward, 20 * 4^level of them
};

Icosphere make_icosphere(int level);

}  // namespace photonproof::inline scenes_meshes
