#include "scenes/files/inside_folder.h"

namespace photonproof::inline scenes_files {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& path, std::error_code& error) {
  // Absolute first: weakly_canonical leaves a relative path relative when none of its parts exist.
  return fs::weakly_canonical(fs::absolute(path.empty() ? "." : path), error);
}

bool is_inside(const fs::path& real, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = real.lexically_relative(real_path(folder, error));
  return !error && !relative.empty() && *relative.begin() != "..";
}

}  // namespace photonproof::inline scenes_files
