#include "harness/verbs/start/data_folder.h"

#include <cstdlib>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_verbs_start {
namespace {

namespace fs = std::filesystem;

bool holds_data(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "scenes/library", error) && fs::is_directory(folder / "harness/suites", error);
}

}  // namespace

fs::path data_folder() {
  if (const char* named = std::getenv("PHOTONPROOF_DATA"); named != nullptr && *named != '\0') {
    if (!holds_data(named)) throw InputError(named, "lacks scenes/library or harness/suites (PHOTONPROOF_DATA)");
    return fs::absolute(named).lexically_normal();
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = (program.parent_path() / "../share/photonproof").lexically_normal();
  for (const fs::path& folder : {installed, fs::path(PHOTONPROOF_SOURCE_DIR)})
    if (holds_data(folder)) return folder;
  throw InputError(installed.string(),
                   "does not exist: install the scenes there, or name their folder in PHOTONPROOF_DATA");
}

}  // namespace photonproof::inline harness_verbs_start
