// Curved bodies as meshes with smooth normals: curves turned about an axis, and tubes along curves. Curves are
// centripetal Catmull-Rom splines (Yuksel et al. 2011, "Parameterization and applications of Catmull-Rom curves").
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_generators {

enum class Ends {
  axis,  ///< both ends lie on x = 0, which the curve meets at a right angle
  open,  ///< as the control points end
  loop,  ///< the last control point is joined to the first
};

struct TubePoint {
  Vec3d at;
  Vec3d tangent;  ///< unit length
};

/// A curve through all `controls`, `per_span` points from each to the next. A loop does not repeat its first point.
/// Precondition: at least three controls, neighbours differ; with Ends::axis the first and the last have x = 0.
std::vector<TubePoint> smooth_curve(const std::vector<Vec3d>& controls, int per_span, Ends ends);

/// The profile, x its radius and y its height, turned about the y axis. Its right side becomes the front: a profile
/// that goes up the outside of a body and down its inside bounds it. Normals are the profile's own. A point with x = 0
/// becomes one vertex, any other `segments` of them, without a seam. Precondition: at least 3 segments; only the first
/// and the last point have x = 0.
TriangleMesh lathe(const std::vector<TubePoint>& profile, Ends ends, std::uint32_t segments);

/// A tube about the curve, one radius a point, facing outward, with round ends where it is no loop.
TriangleMesh tube(const std::vector<TubePoint>& curve, const std::vector<double>& radii, Ends ends,
                  std::uint32_t segments);

/// A ring in the plane y = 0: a circle of radius `minor` turned about the y axis at distance `major`.
TriangleMesh torus(double major, double minor, std::uint32_t around, std::uint32_t across);

/// A sheet y = height(x, z) over a rectangle about the origin, facing +y. `height` gives the height and its derivatives
/// along x and z. Texture coordinates are 0 to 1 along x and z.
struct HeightAt {
  double y, along_x, along_z;
};
template <class Height>
TriangleMesh sheet(double half_x, double half_z, std::uint32_t columns, std::uint32_t rows, const Height& height) {
  TriangleMesh mesh;
  mesh.resize_positions((std::size_t{columns} + 1) * (std::size_t{rows} + 1));
  std::size_t next = 0;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double x = half_x * (2.0 * i / columns - 1), z = half_z * (2.0 * j / rows - 1);
      const HeightAt h = height(x, z);
      mesh.positions[next++] = Vec3f(Vec3d{x, h.y, z});
      mesh.normals.push_back(Vec3f(normalize(Vec3d{-h.along_x, 1, -h.along_z})));
    }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  return mesh;
}

/// Adds the body `part`, turned by `degrees` about y and then moved. Precondition: both have normals, or neither.
void add_part(TriangleMesh& whole, const TriangleMesh& part, double degrees, const Vec3d& offset);

}  // namespace photonproof::inline scenes_generators
