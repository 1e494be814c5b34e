// What a plan decides about a scene before it is built (planning/planner.cpp has the reasons).
#pragma once

namespace photonproof::inline renderer_scene {

/// The defaults leave nothing out.
struct SceneChoices {
  bool small = false;               ///< all primitives are tested one after the other, without Embree
  bool detailed = true;             ///< hits go through detail_at (surface_detail.h)
  bool one_light = false;           ///< none is chosen
  bool one_bsdf_kind = false;       ///< lanes need no sorting
  bool lights_by_position = false;  ///< chosen by the tree over where they are, not by their flux
  bool dark_shadow_rays = true;     ///< shadow rays are traced even where they can bring no light
  bool hides_lights = false;        ///< from the camera, which looks through them
  bool light_paths = true;          ///< some start at the lights, and are guided to what the camera sees
};

}  // namespace photonproof::inline renderer_scene
