// The small scenes that a soak renders again and again: between them they make the renderer build meshes, textures,
// environments, media, photon maps, caches and both ways to trace rays.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_soak {

struct SoakScene {
  std::string name;
  std::filesystem::path file;
};

/// Writes them, with what they need, to a folder that exists.
std::vector<SoakScene> write_soak_scenes(const std::filesystem::path& folder);

}  // namespace photonproof::inline harness_stress_soak
