#include "reports/view/results_file.h"

#include <algorithm>

namespace photonproof::reports::inline reports_view {
namespace fs = std::filesystem;

ResultsFile results_file(const fs::path& folder, const std::string& relative) {
  if (relative.empty()) return {{}, "no picture was made"};
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  const fs::path path = fs::canonical(root / relative, error);
  if (error) return {{}, relative + " is missing"};
  const bool inside = std::mismatch(root.begin(), root.end(), path.begin(), path.end()).first == root.end();
  if (fs::path(relative).is_absolute() || !inside) return {{}, relative + " lies outside the results folder"};
  return {path, {}};
}

}  // namespace photonproof::reports::inline reports_view
