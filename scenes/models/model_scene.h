// Scenes from model files that others wrote: glTF 2.0, and OBJ with MTL, through assimp. It is not made for hostile
// files, so a program of its own reads them (main.cpp), and its caller outlives it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace photonproof::inline scenes_models {

/// Writes `folder`/scene.xml, its meshes as PLY files and its textures beside it. Returns remarks: the camera and the
/// light where the model has none, and what of it is left out. Throws InputError where it cannot be read or has no
/// triangles, or names a file outside its folder without `allow_outside`.
std::vector<std::string> write_model_scene(const std::filesystem::path& model, const std::filesystem::path& folder,
                                           bool allow_outside);

}  // namespace photonproof::inline scenes_models
