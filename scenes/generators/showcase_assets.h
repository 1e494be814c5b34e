// The meshes and textures of the scenes in scenes/showcase. `photonproof generate showcase` writes them at any detail.
// The stored ones have a detail of 1, and a test compares them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace photonproof::inline scenes_generators {

struct ShowcaseAsset {
  std::string path;                                                 ///< within the folder, "gallery/knot.ply"
  std::function<void(const std::filesystem::path&, double)> write;  ///< to a file, at a detail
};

/// All of them. `write` throws InputError when the file cannot be written; its folder must exist.
const std::vector<ShowcaseAsset>& showcase_assets();

}  // namespace photonproof::inline scenes_generators
