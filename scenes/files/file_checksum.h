// The checksum of a whole file.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::inline scenes_files {

/// Checksum::hex of its bytes; empty when it cannot be read.
std::string file_checksum(const std::filesystem::path& file);

}  // namespace photonproof::inline scenes_files
