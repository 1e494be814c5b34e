// The place of the compiled scene's origin, around which single precision is finest.
#pragma once

#include <limits>
#include <vector>

#include "renderer/shapes/extent.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

/// Bounding box of the shape in the description's world, not always tight. It is not usable for endless shapes and for
/// instances.
Extent extent_of(const ShapeDescription& shape);

/// The same for instances, too, with the boxes of all groups computed once.
class ShapeExtents {
 public:
  explicit ShapeExtents(const SceneDescription& description);
  Extent of(const ShapeDescription& shape) const;

 private:
  std::vector<Extent> groups_;  ///< in their own coordinates
};

/// Sizes from the inverse of this up to this are not rescaled.
inline constexpr double ordinary_size = 0x1p22;
inline constexpr double ordinary_size_with_curves = 0x1p4;  ///< Embree's tolerances of curves are lengths, not shares
/// The greatest power of two that is not above x > 0.
double power_of_two_below(double x);

/// Maps the description's coordinates to the compiled scene's: first `scale`, then `moved`.
struct SceneFrame {
  double scale = 1;            ///< A power of two, so that it causes no rounding.
  Vec3d moved{0.0};            ///< Added to the scaled coordinates.
  float coordinate_floor = 1;  ///< Least magnitude of coordinates that ray offsets assume.
  /// Faces with edges above this, scaled, need double precision: rays leave them by less than single precision's error.
  double long_edge = std::numeric_limits<double>::infinity();
};

/// The origin is, per axis, the median of the middles of shapes that have one. The floor is half of the median reach
/// from there: points near the origin are still computed from the scene's coordinates. Where the focus (scene_focus.h)
/// is thousands of times smaller than that or as far away, both are the focus's. So one shape far away, or with a
/// middle far away, does not cost the others their precision. The scale is 1 for a focus between 2^-22 and 2^22;
/// otherwise it makes the focus about 1.
SceneFrame scene_frame(const SceneDescription& description);

}  // namespace photonproof::inline renderer_scene
