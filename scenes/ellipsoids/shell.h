// Triangulated surfaces around the unit ball, as Mitsuba's `ellipsoidsmesh` has them.
#pragma once

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_ellipsoids {

enum class Shell { usual, ico_sphere, box, uv_sphere };

/// 20, 20, 12 or 72 triangles, counter-clockwise seen from outside. They are scaled so that no corner and no triangle's
/// centroid is in the unit ball: other points of a box or a uv_sphere are.
TriangleMesh unit_shell(Shell shell);

}  // namespace photonproof::inline scenes_ellipsoids
