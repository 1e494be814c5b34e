// Whether files that a scene or model names stay in its folder.
#pragma once

#include <filesystem>

namespace photonproof::inline scenes_files {

/// The path without links, which need not exist; an empty one is the current folder.
std::filesystem::path real_path(const std::filesystem::path& path, std::error_code& error);

/// Whether a real_path() is the folder or lies below it. False where the folder cannot be resolved.
bool is_inside(const std::filesystem::path& real, const std::filesystem::path& folder);

}  // namespace photonproof::inline scenes_files
