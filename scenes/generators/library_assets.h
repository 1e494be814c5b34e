// The textures, meshes and light data of the scene library that are made rather than drawn: `photonproof generate
// assets` writes them, and a test holds the library's files to it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace photonproof::inline scenes_generators {

struct LibraryAsset {
  std::string path;  ///< within the library, "light-ies/light.ies"
  bool image;        ///< its pixels count, not its bytes, which depend on the libraries that write them
  std::function<void(const std::filesystem::path&)> write;
};

/// All of them. `write` throws InputError when the file cannot be written; its folder must exist.
const std::vector<LibraryAsset>& library_assets();

}  // namespace photonproof::inline scenes_generators
