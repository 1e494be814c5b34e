// Where the compiled scene puts its origin, since single precision is finest around it.
#pragma once

#include <limits>

#include "scenes/description.h"

namespace photonproof {

/// A box; empty until something is added.
struct Extent {
  Vec3d low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const Vec3d& p);
  void add(const Extent& other);
  bool is_usable() const { return is_finite(low) && is_finite(high); }
  Vec3d middle() const { return (low + high) * 0.5; }
};

/// Around the shape in the world of the description, not always tightly; not usable if it has no end.
Extent extent_of(const SceneDescription& description, const ShapeDescription& shape);

struct SceneFrame {
  Vec3d moved{0.0};            ///< added to the description's coordinates
  float coordinate_floor = 1;  ///< least magnitude of coordinates that ray offsets reckon with
};

/// The origin is the median of the middles of the shapes that have one, axis by axis: one shape far away, or one so
/// large that its middle is, does not cost the others their precision. The floor, a sixteenth of the median reach from
/// there, is for points near the origin, which still come out of arithmetic with the scene's coordinates.
SceneFrame scene_frame(const SceneDescription& description);

}  // namespace photonproof
