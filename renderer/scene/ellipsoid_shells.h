// Meshes of the shells around the ellipsoids of a shape.
#pragma once

#include "renderer/shapes/surface.h"
#include "scenes/ellipsoids/shell.h"

namespace photonproof::inline renderer_scene {

/// A shell around each ellipsoid, flat and with the front outside. Shells of ellipsoids of no extent have no area.
/// Throws std::length_error where the vertices are too many for an index.
Mesh mesh_of_shells(Shell shell, const PlacedEllipsoids& placed, Ellipsoids ellipsoids);

}  // namespace photonproof::inline renderer_scene
