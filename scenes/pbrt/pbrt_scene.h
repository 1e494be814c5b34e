// A file of pbrt-v4 as a folder in the scene format.
#pragma once

#include <filesystem>
#include <vector>

#include "scenes/pbrt/reader.h"

namespace photonproof::inline scenes_pbrt {

/// An error with its line, for those who cannot see the file.
struct PbrtProblem {
  InputError error;
  std::string line;
};

struct PbrtReport {
  std::vector<SceneNote> notes;       ///< what was rendered as something else, or left out
  std::vector<PbrtProblem> problems;  ///< what cannot be read
  std::vector<std::string> included;  ///< the texts that were read beside the file itself
};

/// Writes scene.xml and the files that it names into `folder`. With problems nothing useful is written, unless
/// `lenient`: then they become notes.
PbrtReport write_pbrt_scene(const std::filesystem::path& file, const std::filesystem::path& folder,
                            const PbrtOptions& options, bool lenient);

}  // namespace photonproof::inline scenes_pbrt
