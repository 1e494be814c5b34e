// The rectangle [-1,1]^2 as a mesh, for tests.
#pragma once

#include <memory>

#include "scenes/meshes/mesh.h"

namespace photonproof::test {

/// Two triangles, counter-clockwise seen from +z; the diagonal is from (-1,-1) to (1,1).
inline std::shared_ptr<TriangleMesh> square_mesh() {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(4);
  mesh->positions[0] = {-1, -1, 0};
  mesh->positions[1] = {1, -1, 0};
  mesh->positions[2] = {1, 1, 0};
  mesh->positions[3] = {-1, 1, 0};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace photonproof::test
