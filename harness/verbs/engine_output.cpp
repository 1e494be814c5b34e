#include "harness/verbs/engine_output.h"

#include <cstdio>
#include <filesystem>

#include "reference/engines/engine_run.h"
#include "reference/engines/not_representable.h"
#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs {
namespace fs = std::filesystem;

void check_extension(const std::string& output, const char* extension, const char* kind) {
  if (fs::path(output).extension() != extension)
    throw InputError("--output", "'" + output + "' is not the name of " + kind + ", expected NAME" + extension);
}

std::string checked_stats_path(const std::string& asked, const std::string& image, const std::string& scene) {
  check_extension(image, ".exr", "an EXR");
  return stats_path_beside(asked, image, scene);
}

std::string stats_path_beside(const std::string& asked, const std::string& image, const std::string& scene) {
  const std::string stats = asked.empty() ? fs::path(image).replace_extension(".stats.json").string() : asked;
  prepare_outputs({image, stats}, {{scene, "the scene itself"}});
  if (same_file(stats, image)) throw InputError(stats, "the stats cannot go to the image's own file");
  return stats;
}

int refusing_with_3(const std::function<int()>& run) {
  try {
    return run();
  } catch (const NotRepresentable& refusal) {
    std::fprintf(stderr, "%s\n", refusal.summary().c_str());
    return 3;
  }
}

int interruptibly(const std::function<int()>& run) {
  try {
    return run();
  } catch (const EngineFailure& failure) {
    const bool interrupted = failure.kind == EngineFailure::Kind::interrupted;
    std::fprintf(stderr, "%s: nothing was written\n", interrupted ? "interrupted" : printable(failure.what()).c_str());
    return interrupted ? 130 : failed_engine_exit_code;
  }
}

}  // namespace photonproof::inline harness_verbs
