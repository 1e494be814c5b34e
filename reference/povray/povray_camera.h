// The camera in POV-Ray, and the clip planes POV-Ray does not have.
//
// POV-Ray's coordinates are left-handed only in what it computes from directions (look_at, rotate). A camera given by
// `direction`, `right` and `up` sends its rays along direction + x right + y up whatever the handedness, so a scene
// keeps its coordinates and its image is not mirrored.
#pragma once

#include <string>

#include "reference/engines/lowered_camera.h"
#include "reference/povray/povray_scene.h"

namespace photonproof::inline reference_povray {

using PovCamera = LoweredCamera;

/// "camera{...}" with lengths multiplied by `scale`; `samples` of a lens in every pixel.
std::string camera_sdl(const PovCamera& camera, double scale, int samples);

/// " clipped_by{...}" that leaves what is between the clip planes.
std::string clip_sdl(const PovCamera& camera, double scale);

/// How many pixels across the thinnest of the small lights is in the picture (PovSurface::Emission::spots), as a
/// parallelogram's image is no rectangle: its area over its longest diagonal or side. Infinite where there is none in
/// front of the camera.
double thinnest_light(const PovCamera& camera, const PovScene& scene, int width, int height);

/// Makes the picture what it would be with the clip planes, or proves that it already is. A surface that the near plane
/// hides is made clear from behind (`clear_back`) when the camera sees nothing but its back and nothing else is behind
/// it, so that no light is let through; where nothing is lit surfaces are cut (`clipped`). Throws Unrepresentable for
/// any other surface that a clip plane cuts out of view.
void apply_clip_planes(const PovCamera& camera, PovScene& scene);

}  // namespace photonproof::inline reference_povray
