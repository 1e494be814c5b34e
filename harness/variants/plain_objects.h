// A scene in the terms of a course's scene files (scene_file.h): spheres, rectangles, boxes and water of four
// materials.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline harness_variants {

enum class PlainKind { sphere, rectangle, box, water };
enum class PlainMaterial { diffuse, mirror, glass, light };
const char* word_of(PlainKind kind);
const char* word_of(PlainMaterial material);

/// The members are those of scene_file.h; values that a kind does not have are 0.
struct PlainObject {
  std::string name;
  PlainKind kind = PlainKind::sphere;
  PlainMaterial material = PlainMaterial::diffuse;
  Vec3d middle{0, 0, 0};
  double radius = 0;
  Vec3d a{0, 0, 0}, b{0, 0, 0}, c{0, 0, 0};  ///< half edges; of water, c is the displacement by a height of 1
  RgbD colour{0, 0, 0};
  double ior = 1;
  RgbD radiance{0, 0, 0};
  int columns = 0, rows = 0;
  double frequency_x = 0, frequency_y = 0;
  std::uint32_t noise_seed = 0;
};

struct PlainCamera {
  Vec3d eye, direction, up;  ///< the last two of length 1
  double vertical_fov_degrees, near;
  int shift_x, shift_y;  ///< pixels by which the image lies right of and below the view's middle
};

/// Both throw InputError, which names what these terms cannot express.
std::vector<PlainObject> plain_objects(const SceneDescription& scene);
PlainCamera plain_camera(const SceneDescription& scene, int width, int height);

/// tan of half the vertical angle of view.
double vertical_tangent(const PerspectiveDescription& camera, int width, int height);

}  // namespace photonproof::inline harness_variants
