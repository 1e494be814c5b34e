// The camera in POV-Ray, and the clip planes POV-Ray does not have.
//
// POV-Ray's coordinates are left-handed only in the results of direction helpers (look_at, rotate). A camera given by
// `direction`, `right` and `up` sends its rays along direction + x right + y up in either handedness. So a scene keeps
// its coordinates and its image is not mirrored.
#pragma once

#include <string>

#include "reference/engines/lowered_camera.h"
#include "reference/povray/povray_scene.h"

namespace photonproof::inline reference_povray {

using PovCamera = LoweredCamera;

/// "camera{...}" with lengths multiplied by `scale`; a lens gets `samples` rays in every pixel.
std::string camera_sdl(const PovCamera& camera, double scale, int samples);

/// " clipped_by{...}" that keeps the part between the clip planes.
std::string clip_sdl(const PovCamera& camera, double scale);

/// Width in pixels of the thinnest small light in the image (PovSurface::Emission::spots). A parallelogram's image is
/// no rectangle, so its width is its area over its longest diagonal or side. Infinite where no such light is in front
/// of the camera.
double thinnest_light(const PovCamera& camera, const PovScene& scene, int width, int height);

/// Makes the image equal to one with the clip planes, or proves that it already is. A surface that the near plane hides
/// becomes clear from behind (`clear_back`) when the camera sees only its back and no other surface is behind it. Then
/// no light passes through it. Where nothing is lit, surfaces are cut (`clipped`). Throws Unrepresentable for any other
/// surface that a clip plane cuts out of view.
void apply_clip_planes(const PovCamera& camera, PovScene& scene);

}  // namespace photonproof::inline reference_povray
