// Checks a command's output files against its input files and makes their folders, once, before the work begins.
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

/// The scene with all its includes, and its meshes, images and light data.
std::vector<InputFile> scene_inputs(const SceneDescription& scene);

/// Makes the outputs' folders. Throws InputError when an output could not be written or is one of the inputs, by any
/// name or link.
void prepare_outputs(const std::vector<std::filesystem::path>& outputs, const std::vector<InputFile>& inputs);

/// Whether both names lead to one file, which need not exist.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace photonproof::inline scenes_description
