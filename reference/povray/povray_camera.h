// The camera in POV-Ray, and the clip planes POV-Ray does not have.
//
// POV-Ray's coordinates are left-handed only in what it computes from directions (look_at, rotate). A camera given by
// `direction`, `right` and `up` sends its rays along direction + x right + y up whatever the handedness, so a scene
// keeps its coordinates and its image is not mirrored.
#pragma once

#include <string>

#include "reference/povray/povray_scene.h"

namespace photonproof {

struct PovCamera {
  Vec3d origin;
  Vec3d forward, right, up;  ///< orthonormal, world space; right and up as in the image
  double tan_x = 1;          ///< of half the angle of view, along the image's width
  double tan_y = 1;
  double near_clip = 0;  ///< distances along `forward`
  double far_clip = 0;
};

/// Throws Unrepresentable when the camera's axes are not perpendicular.
PovCamera lower_camera(const SceneDescription& scene, int width, int height);

/// "camera{...}" with lengths multiplied by `scale`.
std::string camera_sdl(const PovCamera& camera, double scale);

/// How many pixels across the thinnest of the small lamps is in the picture (PovSurface::Emission::spots), as a
/// parallelogram's image is no rectangle: its area over its longest diagonal or side. Infinite where there is none in
/// front of the camera.
double thinnest_lamp(const PovCamera& camera, const PovScene& scene, int width, int height);

/// Makes the picture what it would be with the clip planes, or proves that it already is. A surface that the near plane
/// hides is made clear from behind (`clear_back`) when the camera sees nothing but its back and nothing else is behind
/// it, so that no light is let through. Throws Unrepresentable for any other surface that a clip plane cuts out of
/// view.
void apply_clip_planes(const PovCamera& camera, PovScene& scene);

}  // namespace photonproof
