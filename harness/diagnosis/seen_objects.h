// The first surface that a camera sees at every pixel, and the names of objects. Places in words and the formulas of
// direct light (direct_geometry.h) use them.
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
  Vec3d normal_world{0, 0, 0};  ///< length 1, towards the camera
};

/// Row by row. Meshes count as their bounding boxes, heightfields as level; shapes that rooms do not have are left out.
/// All 0 where the camera is not a perspective one.
std::vector<SeenPlace> seen_points(const SceneDescription& scene, int width, int height);

/// The name of each shape: "glass sphere", "left wall", "light", "water", by material, shape, and place in the camera's
/// view. Where several have one name, "2nd glass sphere" counts from the left.
std::vector<std::string> object_names(const SceneDescription& scene);

enum class Look { diffuse, mirror, glass, other };
Look look_of(const SceneDescription& scene, const ShapeDescription& shape);

/// Sets landmarks for the shapes that are seen in at least 4 pixels, and the pixels of each.
void set_landmarks(SceneKnowledge& knowledge, const SceneDescription& scene, const std::vector<SeenPlace>& points,
                   int width, int height);

}  // namespace photonproof::inline harness_diagnosis
