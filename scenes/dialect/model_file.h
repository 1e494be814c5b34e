// Files that are models, to which a camera and light are supplied, or scenes of pbrt-v4.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/description/scene_note.h"

namespace photonproof::inline scenes_dialect {

/// Whether a file is a model by the ending of its name: .ply, .serialized, .obj, .gltf, .glb
/// or .pbrt.
bool is_model(const std::filesystem::path& file);

/// A model as scene XML.
struct ModelScene {
  std::string text;  ///< names files in `folder`
  std::filesystem::path folder;
  std::vector<SceneNote> notes;         ///< what was supplied, left out or rendered as something else
  std::vector<std::string> included{};  ///< other texts that were read
};

struct ModelOptions {
  bool allow_outside = false;  ///< let files that it names leave its folder
  bool lenient = false;        ///< leave out what cannot be read
};

/// The scene of a model. A mesh alone is named in place. Scenes of pbrt, glTF, and OBJ with an MTL file, are written
/// into `folder` by another program, which may take five minutes. Throws InputError where the model cannot be read; of
/// pbrt's one that tells all problems.
ModelScene read_model(const std::filesystem::path& model, const std::filesystem::path& folder,
                      const ModelOptions& options = {});

}  // namespace photonproof::inline scenes_dialect
