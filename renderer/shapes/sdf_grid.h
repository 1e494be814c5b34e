// Zeros of signed distances on a grid, interpolated trilinearly (Hansson-Soederlund, Evans and Akenine-Moeller 2022:
// "Ray Tracing of Signed Distance Function Grids").
#pragma once

#include <array>
#include <memory>

#include "renderer/shapes/shape.h"
#include "scenes/description/transform.h"
#include "scenes/meshes/vol.h"

namespace photonproof::inline scenes_description {
struct SdfGridDescription;
}

namespace photonproof::inline renderer_shapes {

struct SdfGrid {
  std::shared_ptr<const VolumeGrid> grid;  ///< sample i along an axis is at i in the grid's coordinates
  Transform to_world, to_grid;             ///< from the grid's coordinates, and back
  double largest = 0;                      ///< magnitude of its coordinates in the world
  bool smooth = false;                     ///< shading normals are continuous across voxels
  bool inward = false;                     ///< the normal points to where distances are negative

  static constexpr bool is_round = false;
  float curvature_radius() const { return 0; }
  bool sees_itself(bool) const { return true; }
};

double hit_distance(const SdfGrid& sdf, const ShapeRay& ray);
ShapePoint point_on(const SdfGrid& sdf, const Vec3d& near);
ShapeBox box_around(const SdfGrid& sdf);
/// Has no texture coordinates, as Mitsuba's.
LocalGeometry local_geometry(const SdfGrid& sdf, const AffineMap& frame, const Vec3f& p, const Vec3f& normal);
/// Counts the sheet that p is on. By quadrature, accurate to 1e-3 where that sheet is smooth and has no border.
float disc_area(const SdfGrid& sdf, const Vec3f& p, float radius);
PlacedShape<SdfGrid> placed(const SdfGridDescription& description, const ShapePlace& place);
Extent extent_of(const SdfGridDescription& description, const Transform& to_world);
/// In the unit cube.
Vec3d nearest_on(const SdfGridDescription& description, const Transform& to_world, const Vec3d& to);

}  // namespace photonproof::inline renderer_shapes
