// An approximation of the visible scene: balls around the ends of some camera rays. Light paths are guided by them.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/shapes/projection_cone.h"

namespace photonproof::inline renderer_scene {

/// The points where rays through the middles of lattice x lattice cells of the image first meet a surface; rays that
/// miss are left out.
std::vector<Vec3f> points_looked_at(const Scene& scene, int lattice);

/// Balls around the first surfaces that a lattice of camera rays meets, each as large as its cell of the image there.
std::vector<ProjectionTarget> looked_at(const Scene& scene);

}  // namespace photonproof::inline renderer_scene
