// A scene's camera as other engines need it: its position, axes and lens, for every camera plugin.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline reference_engines {

struct LoweredCamera {
  enum class Kind { perspective, thin_lens, orthographic, fisheye } kind = Kind::perspective;
  Vec3d origin;
  Vec3d forward, right, up;  ///< Orthonormal, world space. Right and up are as in the image.
  /// Half the image's width and height one unit ahead. Orthographic: in scene units.
  double tan_x = 1, tan_y = 1;
  double middle_x = 0, middle_y = 0;  ///< image centre relative to the axis, in halves of the image's width and height
  double lens_radius = 0, focus_distance = 1;
  double angle = 0;      ///< fisheye: field of view in radians
  double near_clip = 0;  ///< clip distances along `forward`
  double far_clip = 0;
};

/// The camera of an image of this size with `margin` pixels around it. Throws NotRepresentable, with the engine's name,
/// when the camera's axes are not perpendicular, or when a fisheye's image is not square.
LoweredCamera lower_camera(const SceneDescription& scene, int width, int height, int margin, const std::string& engine);

}  // namespace photonproof::inline reference_engines
