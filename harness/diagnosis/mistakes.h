// Scenes with a common mistake built in: rendered, they are what a program with this mistake shows.
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
  /// Where the mistake shows: only where these shapes are seen (their indices); empty: everywhere.
  std::vector<std::size_t> only_where_seen;
  bool direct_only = false;  ///< only direct light is rendered and differs
  /// Shapes that it changes wherever they are seen; empty: unknown.
  std::vector<std::size_t> changes = {};
  bool rough = false;  ///< the scene has only part of what it changes
  bool rare = false;   ///< of several that differ in a number, or seldom made
  bool faint = false;  ///< a fine pattern, which noise and wide gathers hide: WhatIf::fine
};

/// `names` as object_names() gives them; `visible`: of each shape, whether the camera sees it.
std::vector<Mistake> mistakes_of(const SceneDescription& scene, const std::vector<std::string>& names,
                                 const std::vector<bool>& visible);

/// The same without spheres, boxes and panes: what casts shadows in a room.
SceneDescription without_bodies(const SceneDescription& scene);
bool is_body(const SceneDescription& scene, const ShapeDescription& shape);

}  // namespace photonproof::inline harness_diagnosis
