// Scenes with a common mistake built in. Their pictures are those of a program with this mistake.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline harness_diagnosis {

struct Mistake {
  std::string kind, sentence, cause;
  std::string landmark;
  SceneDescription scene;
  /// Indices of the shapes whose pixels alone show the mistake; empty: all pixels.
  std::vector<std::size_t> only_where_seen;
  bool direct_only = false;  ///< only direct light is rendered and differs
  /// Shapes whose pixels it changes; empty: unknown.
  std::vector<std::size_t> changes = {};
  bool rough = false;  ///< the scene has only part of the change
  bool rare = false;   ///< one of several with different numbers, or seldom made
  bool faint = false;  ///< a fine pattern, which noise and wide gathers hide: WhatIf::fine
};

/// `names`: from object_names(). `visible`: whether the camera sees the shape.
std::vector<Mistake> mistakes_of(const SceneDescription& scene, const std::vector<std::string>& names,
                                 const std::vector<bool>& visible);

/// The scene without spheres, boxes and panes, which cast the shadows in a room.
SceneDescription without_objects(const SceneDescription& scene);
bool is_object(const SceneDescription& scene, const ShapeDescription& shape);

}  // namespace photonproof::inline harness_diagnosis
