// Messages about scenes that another engine cannot express.
#pragma once

#include <string>

#include "scenes/base/input_error.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_engines {

// Shapes may name the meshes of this folder.
inline const std::string kScene = PHOTONPROOF_CORPORA "/ply_corpus/scene.xml";

inline const std::string kCamera =
    "<sensor type='perspective'><transform name='to_world'><lookat origin='0 0 9' target='0 0 0' up='0 1 0'/>"
    "</transform><film type='hdrfilm'><rfilter type='box'/></film></sensor>\n";

/// The error with which `write` refuses a scene with a camera in line 1 and `content` from line 2 on, without the
/// file's name.
template <class Write>
std::string refusal_by(const Write& write, const std::string& content, const std::string& camera) {
  const SceneDescription scene =
      parse_scene_text("<scene version='3.0.0'>" + camera + content + "</scene>", kScene, {{}, true});
  try {
    write(scene);
    return "no refusal";
  } catch (const InputError& error) {
    const std::string message = error.summary();
    return message.rfind(kScene, 0) == 0 ? message.substr(kScene.size() + 1) : message;
  }
}

}  // namespace photonproof::inline reference_engines
