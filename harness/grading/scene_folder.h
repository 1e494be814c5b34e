// A scene for a program that reads our format: scene.xml and the files that it names.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline harness_grading {

struct SceneFolder {
  std::filesystem::path path;  ///< empty: none
  std::string checksum;        ///< checksum of all its files
};

/// Makes the folder, replacing an old one. Files have numbers for names, which reveal nothing of a hidden scene. Throws
/// InputError for files that cannot be read or written.
SceneFolder make_scene_folder(SceneDescription scene, const std::filesystem::path& folder);

}  // namespace photonproof::inline harness_grading
