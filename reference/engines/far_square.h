// A plane without end as a square far beyond everything, for engines that have no planes.
#pragma once

#include <memory>

#include "scenes/base/bounds.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_engines {

/// In the plane's own space and uv, 1000 times the size of `scene`, around its middle. Null for a to_world without an
/// inverse.
std::shared_ptr<TriangleMesh> far_square(const Transform& to_world, const Bounds3d& scene);

}  // namespace photonproof::inline reference_engines
