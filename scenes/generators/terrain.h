// A procedural landscape: hills that rise to mountains, and rocks that lie on them. The same arguments give the same
// bits on every machine.
#pragma once

#include <cstdint>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_generators {

constexpr double kTerrainHalfSize = 10;  ///< the ground spans [-10,10]^2 in x and z; y is up

/// Height of the ground; the mountains are towards -z.
double ground_height(double x, double z);

/// The ground as a grid of `columns` times `rows` cells along x and z, two triangles a cell, facing +y.
TriangleMesh make_ground(std::uint32_t columns, std::uint32_t rows);

/// `count` closed bodies of 20 * 4^level triangles each, facing outward, half sunk into the ground.
TriangleMesh make_rocks(std::uint32_t count, int level);

}  // namespace photonproof::inline scenes_generators
