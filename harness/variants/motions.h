// Moves or mirrors a whole scene.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

/// Turns and moves everything: shapes, lights, camera. Precondition: `motion` is a rotation and a translation.
void move_everything(SceneDescription& scene, const Transform& motion);

/// Mirrors everything except the camera in the plane through the camera's middle column, so that the image's left and
/// right change places. Throws InputError where a scene file cannot express a light's or texture's mirror image.
void mirror_in_view(SceneDescription& scene);

}  // namespace photonproof::inline harness_variants
