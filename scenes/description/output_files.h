// What a command is about to write, held against what it reads: asked once, before the work begins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_description {

struct InputFile {
  std::filesystem::path file;
  std::string what;  ///< "the scene itself": completes "FILE: error: is ..."
};

/// The scene with all that it includes, and its meshes, images and light data.
std::vector<InputFile> scene_inputs(const SceneDescription& scene);

/// Throws InputError when one of the outputs could not be written or is a file that is read, by whatever name or link.
void check_outputs(const std::vector<std::filesystem::path>& outputs, const std::vector<InputFile>& inputs);

/// Whether both names lead to one file, which need not exist.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace photonproof::inline scenes_description
