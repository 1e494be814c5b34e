// The box around a shape of a description, in double precision; it determines the compiled scene's origin.
#pragma once

#include <limits>

#include "scenes/base/vec.h"
#include "scenes/description/transform.h"

namespace photonproof::inline renderer_shapes {

/// A box; empty until something is added.
struct Extent {
  Vec3d low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const Vec3d& p);
  void add(const Extent& other);
  /// Adds the corners of a local box.
  void add_box(const Transform& to_world, const Vec3d& local_low, const Vec3d& local_high);
  /// `center` and `radius` are local; to_world scales evenly.
  void add_ball(const Transform& to_world, const Vec3d& center, double radius);
  bool is_usable() const { return is_finite(low) && is_finite(high); }
  Vec3d middle() const { return (low + high) * 0.5; }
};

}  // namespace photonproof::inline renderer_shapes
