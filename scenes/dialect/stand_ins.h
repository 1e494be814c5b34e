// Plugins and parameters of other versions of Mitsuba, written as those that this renderer has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/description/scene_note.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// A parameter that does not change what an image converges to. It is accepted and has no effect.
struct HarmlessParameter {
  std::string_view tag, name, meaning;
};
const std::vector<HarmlessParameter>& harmless_parameters();

/// A plugin and the one that stands in for it. `loss` is the difference, empty where the image converges to the same.
struct StandIn {
  std::string_view tag, type, becomes, loss;
};
const std::vector<StandIn>& stand_ins();

/// Rewrites the tree of a scene, so that it has only plugins of docs/formats/scene.md where that is possible. What
/// changes the image, and each integrator that stands in for another, becomes a note. The rest is left to the reader.
std::vector<SceneNote> use_stand_ins(const Sources& sources, Element& root);

}  // namespace photonproof::scene_xml
