#include "harness/verbs/engine_output.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "reference/engines/engine_run.h"
#include "reference/engines/not_representable.h"
#include "scenes/base/input_error.h"
#include "scenes/base/timer.h"
#include "scenes/base/utf8.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs {
namespace fs = std::filesystem;

std::string time_left(double seconds, double done, double left) {
  constexpr double least_done = 0.002;  // before, the estimate would be noise
  if (done < least_done || left <= 0) return "";
  const double expected = seconds * left / done;
  char text[48];
  if (expected < 60)
    std::snprintf(text, sizeof text, ", %.0f s left", expected);
  else if (expected < 3600)
    std::snprintf(text, sizeof text, ", %.0f min left", expected / 60);
  else
    std::snprintf(text, sizeof text, ", %.1f h left", expected / 3600);
  return text;
}

std::function<void(double, const std::string&)> progress_line(bool quiet) {
  if (quiet || isatty(STDERR_FILENO) == 0) return {};
  return [timer = Timer(), first = std::optional<double>()](double fraction, const std::string& phase) mutable {
    if (!first) first = fraction;
    const std::string left = time_left(timer.seconds(), fraction - *first, 1 - fraction);
    std::fprintf(stderr, "\r%3.0f %% %s%s\033[K", 100 * fraction, phase.c_str(), left.c_str());
    if (fraction >= 1) std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
  };
}

std::string checked_stats_path(const std::string& asked, const std::string& image, const std::string& scene) {
  if (fs::path(image).extension() != ".exr")
    throw InputError("--output", "'" + image + "' is not the name of an EXR, expected NAME.exr");
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
