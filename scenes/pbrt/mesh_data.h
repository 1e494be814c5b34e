// Triangles of pbrt's parameters, checked and completed.
#pragma once

#include "scenes/meshes/mesh.h"
#include "scenes/pbrt/parameters.h"

namespace photonproof::inline scenes_pbrt {

/// "point3 P" with "integer indices", "normal N" and "point2 uv". Texture coordinates stay pbrt's. Throws InputError.
TriangleMesh triangle_mesh_of(const PbrtParameters& parameters);
/// "bilinearmesh": each patch as two triangles; `is_bent` says whether a patch does not lie in a plane.
TriangleMesh bilinear_mesh_of(const PbrtParameters& parameters, bool& is_bent);
/// The front is where the vertex normals point.
void turn_to_normals(TriangleMesh& mesh);
/// (u, v) becomes (u, 1 - v); without coordinates each triangle gets (0,0), (1,0), (1,1), as in pbrt.
void complete_coordinates(TriangleMesh& mesh);

}  // namespace photonproof::inline scenes_pbrt
