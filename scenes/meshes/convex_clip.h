// Small computational geometry: the part of a flat polygon inside a convex region, and the distance of a point from a
// parallelogram or a triangle.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_meshes {

/// The half-space dot(normal, p) <= offset.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

/// The part of a convex polygon inside every half-space (Sutherland and Hodgman 1974); empty when there is none.
std::vector<Vec3d> clip_polygon(std::vector<Vec3d> polygon, std::span<const HalfSpace> region);

/// Area of a planar polygon, any winding; 0 for fewer than three vertices.
double polygon_area(std::span<const Vec3d> polygon);

/// Smallest distance from `p` to the parallelogram corner + s u + t v, s and t in [0,1].
double distance_to_parallelogram(const Vec3d& p, const Vec3d& corner, const Vec3d& edge_u, const Vec3d& edge_v);

/// Smallest distance from `p` to the triangle, which may be degenerate.
double distance_to_triangle(const Vec3d& p, const std::array<Vec3d, 3>& triangle);

}  // namespace photonproof::inline scenes_meshes
