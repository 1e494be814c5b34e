// A scene's camera as other engines are told of it: where it is, its axes and its lens, whatever the plugin.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline reference_engines {

struct LoweredCamera {
  enum class Kind { perspective, thin_lens, orthographic, fisheye } kind = Kind::perspective;
  Vec3d origin;
  Vec3d forward, right, up;  ///< orthonormal, world space; right and up as in the image
  /// Half the image's width and height one unit ahead; in scene units when orthographic.
  double tan_x = 1, tan_y = 1;
  double middle_x = 0, middle_y = 0;  ///< of the image, in halves of its width and height from the axis
  double lens_radius = 0, focus_distance = 1;
  double angle = 0;      ///< of view in radians, fisheye
  double near_clip = 0;  ///< distances along `forward`
  double far_clip = 0;
};

/// Of a picture of this size with `margin` pixels around it. Throws NotRepresentable, with the engine's name, when the
/// camera's axes are not perpendicular, or when a fisheye's picture is not square.
LoweredCamera lower_camera(const SceneDescription& scene, int width, int height, int margin, const std::string& engine);

}  // namespace photonproof::inline reference_engines
