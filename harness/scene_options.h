// The options every verb that reads a scene shares.
#pragma once

#include <string>
#include <vector>

#include "scenes/description.h"

namespace CLI {
class App;
}

namespace photonproof {

struct SceneOptions {
  std::string path;
  std::vector<std::string> defines;  ///< "name=value"
  std::string size;                  ///< "WxH", empty: the scene's
  bool allow_outside = false;
};

/// SCENE, -D, --size, --allow-outside.
void add_scene_options(CLI::App& verb, SceneOptions& options);

/// Parses the scene; its film has the size asked for. Throws InputError.
SceneDescription load_scene(const SceneOptions& options);

}  // namespace photonproof
