#include "reference/mitsuba/mitsuba_python.h"

#include <cstdlib>

#include "scenes/base/process.h"

namespace photonproof::inline reference_mitsuba {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::optional<std::string> find_mitsuba_python(const fs::path& program) {
  const char* given = std::getenv(mitsuba_python_variable);
  if (given != nullptr && *given != '\0') return given;
  std::error_code error;
  // TREE/build/PRESET/bin/photonproof
  const fs::path real = fs::canonical(program, error);
  if (!error) {
    const fs::path peers = real.parent_path().parent_path().parent_path() / "peers/bin/python";
    if (fs::exists(peers, error)) return peers.string();
  }
  if (!mitsuba_version("python3").empty()) return "python3";
  return std::nullopt;
}

std::string mitsuba_version(const std::string& python) {
  // The module's import alone takes 0.1 s; its version needs no variant.
  const ProcessOutcome outcome =
      run_process({python, "-c", "import mitsuba; print('Mitsuba', mitsuba.__version__)"}, {.wall_limit_seconds = 60});
  if (!outcome.ok()) return "";
  return last_line(outcome.standard_output);
}

}  // namespace photonproof::inline reference_mitsuba
