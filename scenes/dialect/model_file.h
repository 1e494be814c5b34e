// Files that are models rather than scenes: a camera and light are supplied.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace photonproof::inline scenes_dialect {

/// Whether a file is a model by the ending of its name: .ply, .serialized, .obj, .gltf or .glb.
bool is_model(const std::filesystem::path& file);

/// A model as scene XML.
struct ModelScene {
  std::string text;  ///< names files in `folder`
  std::filesystem::path folder;
  std::vector<std::string> remarks;  ///< what was supplied or left out
};

/// The scene of a model. A mesh alone is named in place; glTF, and OBJ with an MTL file, are written into `folder` by
/// another program, which may take five minutes. Throws InputError where the model cannot be read.
ModelScene read_model(const std::filesystem::path& model, const std::filesystem::path& folder);

}  // namespace photonproof::inline scenes_dialect
