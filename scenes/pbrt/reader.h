// Reads the directives of a pbrt-v4 scene.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/description/description.h"
#include "scenes/pbrt/sources.h"

namespace photonproof::inline scenes_pbrt {

struct PbrtOptions {
  bool allow_outside = false;
};

/// The scene of a text that stands for the file `name`. Files that are made for it, and copies of those that it names,
/// go into `made`; without a name of that, nowhere. Problems and remarks go into the log. Throws InputError where
/// reading cannot go on.
SceneDescription read_pbrt(PbrtSources& sources, PbrtLog& log, std::string text, const std::string& name,
                           const std::filesystem::path& made, const PbrtOptions& options);

}  // namespace photonproof::inline scenes_pbrt
