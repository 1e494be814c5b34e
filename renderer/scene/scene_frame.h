// Where the compiled scene puts its origin, since single precision is finest around it.
#pragma once

#include <limits>
#include <vector>

#include "renderer/shapes/extent.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

/// Around the shape in the world of the description, not always tightly; not usable if it has no end, or is an
/// instance.
Extent extent_of(const ShapeDescription& shape);

/// The same of instances, too, with the boxes of all groups worked out once.
class ShapeExtents {
 public:
  explicit ShapeExtents(const SceneDescription& description);
  Extent of(const ShapeDescription& shape) const;

 private:
  std::vector<Extent> groups_;  ///< in their own coordinates
};

/// Sizes up to this and down to its inverse are left alone.
inline constexpr double ordinary_size = 0x1p22;
/// The greatest power of two that is not above x > 0.
double power_of_two_below(double x);

/// How the compiled scene's coordinates come from the description's: `scale` first, then `moved`.
struct SceneFrame {
  double scale = 1;            ///< a power of two, so that it rounds nothing
  Vec3d moved{0.0};            ///< added to the scaled coordinates
  float coordinate_floor = 1;  ///< least magnitude of coordinates that ray offsets reckon with
  /// Faces with edges above this, scaled, need double precision: rays leave them by less than single precision's error.
  double long_edge = std::numeric_limits<double>::infinity();
};

/// The origin is the median of the middles of the shapes that have one, axis by axis, the floor, half of the
/// median reach from there, for points near the origin, which still come out of arithmetic with the scene's
/// coordinates. Where what the camera looks at (scene_focus.h) is thousands of times smaller than that or as far away,
/// both are the focus's: one shape far away, or one so large that its middle is, does not cost the others their
/// precision. The scale is 1 unless the focus is smaller than 2^-22 or larger than 2^22; then it makes it about 1.
SceneFrame scene_frame(const SceneDescription& description);

}  // namespace photonproof::inline renderer_scene
