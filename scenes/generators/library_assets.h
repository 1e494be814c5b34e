// The generated textures, meshes and light data of the scene library. `photonproof generate assets` writes them, and a
// test compares the library's files with them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace photonproof::inline scenes_generators {

struct LibraryAsset {
  std::string path;  ///< within the library, "light-ies/light.ies"
  bool image;        ///< compared by its pixels, since its bytes depend on the libraries that write them
  std::function<void(const std::filesystem::path&)> write;
};

/// All of them. `write` throws InputError when the file cannot be written; its folder must exist.
const std::vector<LibraryAsset>& library_assets();

}  // namespace photonproof::inline scenes_generators
