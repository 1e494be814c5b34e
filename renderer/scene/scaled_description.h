// The same scene in another unit of length.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

/// Every length of shapes, emitters, media, camera and bump maps times `factor`, and intensities (W/sr) times its
/// square: the image is the same. The contents of shape groups stay, since the instances' placements scale them. The
/// integrator's radii stay, too, since it gets them from the description itself.
SceneDescription scaled(SceneDescription description, double factor);

}  // namespace photonproof::inline renderer_scene
