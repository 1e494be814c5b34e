// The small scenes that a soak renders again and again. Together they make the renderer build meshes, textures,
// environments, media, photon maps, caches and both ray tracing structures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace photonproof::inline harness_stress_soak {

struct SoakScene {
  std::string name;
  std::filesystem::path file;
};

/// Writes the scenes with their files to an existing folder.
std::vector<SoakScene> write_soak_scenes(const std::filesystem::path& folder);

}  // namespace photonproof::inline harness_stress_soak
