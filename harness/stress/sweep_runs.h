// Changes of a whole scene that leave its picture as it is, or multiply it by a number. Shares no code with the
// renderer, which moves and scales scenes, too.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline harness_stress {

/// Every length times `by`: shapes, lights, camera, media, bumps, radii of photons. Intensities (W/sr) go with its
/// square, so that the picture is the same. Shape groups stay: their instances are scaled.
SceneDescription in_another_unit(SceneDescription scene, double by);

/// Everything moved, camera and lights too.
SceneDescription moved(SceneDescription scene, const Vec3d& by);

/// Turned as a whole by 40 degrees about (1, 2, 3), along which no face of a stage lies.
SceneDescription turned(SceneDescription scene);

/// Every light times `by`; so is the picture.
SceneDescription brighter(SceneDescription scene, double by);

}  // namespace photonproof::inline harness_stress
