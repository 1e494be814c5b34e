// Balls around the specular surfaces, where caustics begin. All surfaces that are not Lambertian count as specular. The
// caustic map's photons go only into their cones (Jensen 2001, section 5.2.1, "projection maps", in closed form).
#pragma once

#include <functional>
#include <vector>

#include "renderer/shapes/projection_cone.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_scene {

/// More cones than this cost more to weigh than they save.
inline constexpr std::size_t most_projection_targets = 16;

/// Nothing around an empty box.
ProjectionTarget ball_around_box(const ShapeBox& box);

/// One ball for each specular surface, which it encloses.
std::vector<ProjectionTarget> projection_targets(const std::vector<Surface>& surfaces,
                                                 const std::function<bool(const Surface&)>& is_specular);

}  // namespace photonproof::inline renderer_scene
