// Settings by one name: those of a course's assignment, whose pictures students render.
#pragma once

#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline harness_verbs_render {

struct RenderPreset {
  const char* name;
  const char* meaning;  ///< for --help
  int grid;             ///< as RenderJob has it, where no other is asked for
  /// Changes the scene's integrator, samples a pixel and, unless one is asked for, size. Says what it does, for --plan.
  std::string (*apply)(SceneDescription& scene, bool size_is_asked_for);
};

const std::vector<RenderPreset>& render_presets();
/// Null where the name is empty. Throws InputError where there is none of the name.
const RenderPreset* preset_named(const std::string& name);

}  // namespace photonproof::inline harness_verbs_render
