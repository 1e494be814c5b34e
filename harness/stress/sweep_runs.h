// Changes of a whole scene that keep its picture or multiply it by a number. The code is independent of the renderer's,
// which also moves and scales scenes.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline harness_stress {

/// Every length times `by`: shapes, lights, camera, media, bumps, radii of photons. Intensities (W/sr) scale with its
/// square, so that the picture is the same. Shape groups stay: their instances are scaled.
SceneDescription in_another_unit(SceneDescription scene, double by);

/// Moves everything, camera and lights too.
SceneDescription moved(SceneDescription scene, const Vec3d& by);

/// Turns the whole scene by 40 degrees about (1, 2, 3), an axis along which no face of a stage lies.
SceneDescription turned(SceneDescription scene);

/// Multiplies every light, and thus the picture, by `by`.
SceneDescription brighter(SceneDescription scene, double by);

}  // namespace photonproof::inline harness_stress
