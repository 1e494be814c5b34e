// Vertex normals of a mesh whose file has none.
#pragma once

#include <vector>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline renderer_shapes {

/// Means of the adjoining triangles' normals, weighted by their angles at the vertex (Thuermer and Wuethrich 1998),
/// unit; zero at vertices of no triangle. `positions` are the mesh's, in any space.
std::vector<Vec3f> vertex_normals(const std::vector<TriangleMesh::Triangle>& triangles,
                                  const std::vector<Vec3f>& positions, std::size_t vertex_count);

}  // namespace photonproof::inline renderer_shapes
