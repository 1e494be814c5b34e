// A plan's decisions about a scene before it is built (planning/planner.cpp has the reasons).
#pragma once

namespace photonproof::inline renderer_scene {

/// The defaults leave nothing out.
struct SceneChoices {
  bool small = false;               ///< All primitives are tested one after the other, without Embree.
  bool detailed = true;             ///< Hits go through detail_at (surface_detail.h).
  bool one_light = false;           ///< There is no choice of a light.
  bool one_bsdf_kind = false;       ///< Lanes need no sorting.
  bool lights_by_position = false;  ///< A tree over the lights' places chooses them, instead of their flux.
  bool dark_shadow_rays = true;     ///< Shadow rays are traced even where they can bring no light.
  bool hides_lights = false;        ///< The camera looks through lights.
  bool light_paths = true;          ///< Some start at the lights, and are guided to the visible scene.
};

}  // namespace photonproof::inline renderer_scene
