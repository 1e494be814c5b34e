// The folder of a record, where its pictures lie.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::inline harness_verbs {

/// The folder of a file named on the command line; "results.json" alone is in the current one.
inline std::filesystem::path folder_of(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

}  // namespace photonproof::inline harness_verbs
