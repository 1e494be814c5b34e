// What a camera sees first at every pixel, and what its objects are called: for places in words, and for light whose
// geometry is known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_diagnosis {

struct SeenPlace {
  std::uint16_t object = 0;  ///< 1 + its index in SceneDescription::shapes; 0: none
  Vec3d position_world{0, 0, 0};
  Vec3d normal_world{0, 0, 0};  ///< of length 1, towards the camera
};

/// Row by row. Meshes count as the boxes around them, heightfields as level; other shapes than those of a room are not
/// seen. All 0 where the camera is not a perspective one.
std::vector<SeenPlace> seen_points(const SceneDescription& scene, int width, int height);

/// Of each shape, "glass sphere", "left wall", "light", "water": by material, shape, and place in the camera's view.
/// Where several have one name, "2nd glass sphere" counts from the left.
std::vector<std::string> object_names(const SceneDescription& scene);

enum class Look { diffuse, mirror, glass, other };
Look look_of(const SceneDescription& scene, const ShapeDescription& shape);

/// Landmarks of the shapes that are seen in at least 4 pixels, and which is seen where.
void set_landmarks(SceneKnowledge& knowledge, const SceneDescription& scene, const std::vector<SeenPlace>& points,
                   int width, int height);

}  // namespace photonproof::inline harness_diagnosis
