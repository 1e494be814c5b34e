// Point sets spread evenly over a square and a sphere.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline reference_optics {

/// N x N points of the unit square for N of at least 1 (correlated multi-jittered sampling, Kensler 2013). Every cell
/// of an N x N grid has one, and so has every column and row of an N^2 grid. Columns are shifted opposite to rows, so
/// that x and y do not correlate. With separate random orders the mean of x y errs by up to 0.3 % of the square's, and
/// so is the irradiance from a light to one side. The same seed gives the same points.
std::vector<Vec2<double>> square_points(int n, std::uint64_t seed);

/// Unit vectors spread evenly over the sphere along a Fibonacci spiral (Swinbank and Purser 2006), turned by the seed.
std::vector<Vec3d> sphere_points(int count, std::uint64_t seed);

}  // namespace photonproof::inline reference_optics
