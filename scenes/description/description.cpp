#include "scenes/description/description.h"

namespace photonproof {

std::string SceneDescription::where(const SourceLoc& loc) const {
  const bool known_file = loc.file >= 0 && static_cast<std::size_t>(loc.file) < files.size();
  std::string file = known_file ? files[static_cast<std::size_t>(loc.file)] : "<scene>";
  if (loc.line <= 0) return file;
  return file + ":" + std::to_string(loc.line) + ":" + std::to_string(loc.column);
}

}  // namespace photonproof
