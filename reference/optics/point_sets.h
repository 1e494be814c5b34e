// Places spread evenly over a square and a sphere.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline reference_optics {

/// N x N points of the unit square, one in every cell of an N x N grid and one in every column and row of an N^2 grid
/// (correlated multi-jittered sampling, Kensler 2013), for every N of at least 1. Columns are shifted as rows are, but
/// the other way, so that x and y do not correlate: with an order for each, x y is off by up to 0.3 % of the square's,
/// and the light of a light to one side by as much. The same seed gives the same points.
std::vector<Vec2<double>> square_points(int n, std::uint64_t seed);

/// Unit vectors spread evenly over the sphere along a Fibonacci spiral (Swinbank and Purser 2006), turned by the seed.
std::vector<Vec3d> sphere_points(int count, std::uint64_t seed);

}  // namespace photonproof::inline reference_optics
