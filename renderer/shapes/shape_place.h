// From a shape of the description to one of the compiled scene.
#pragma once

#include <optional>
#include <string>

#include "renderer/shapes/affine_map.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_shapes {

/// A shape of a description that becomes one primitive.
struct ShapePlace {
  const SceneDescription& scene;
  const ShapeDescription& shape;
  const Transform& to_world;  ///< to the compiled scene's coordinates

  [[noreturn]] void refuse(const std::string& why) const;
  /// Refuses a to_world that stretches or shears.
  void require_similarity() const;
  /// Normal of the plane of two edges that are to_world's images of the local x and y axes. It is the inverse
  /// transpose's; a mirroring transform does not turn it over as it does the winding.
  Vec3d flat_normal(const Vec3d& edge_u, const Vec3d& edge_v) const;
};

template <class Shape>
struct PlacedShape {
  Shape shape;
  AffineMap uv_frame;          ///< from its own space, where it is of unit size
  std::optional<double> area;  ///< empty for an endless shape
};

/// The frame of a flat shape: its two edges and, across it, a unit normal.
AffineMap flat_frame(const Vec3d& origin, const Vec3d& along_u, const Vec3d& along_v);

}  // namespace photonproof::inline renderer_shapes
