// A scene as a whole, moved or mirrored.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// Turns and moves everything: shapes, lights, camera. Precondition: `motion` is a rotation and a translation.
void move_everything(SceneDescription& scene, const Transform& motion);

/// Mirrors everything but the camera in the plane through the camera's middle column, so that left and right change
/// places in the image. Throws InputError where a light or texture has no mirror image that a scene could say.
void mirror_in_view(SceneDescription& scene);

}  // namespace photonproof::inline harness_variants
