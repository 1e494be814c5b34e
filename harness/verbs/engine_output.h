// The parts that verbs with output files share: their names, the place of the stats, and the exit codes of failures.
#pragma once

#include <functional>
#include <string>

namespace photonproof::inline harness_verbs {

/// Throws InputError at "--output" where the file's name does not end in `extension`. `kind` is "an EXR" or "a page".
void check_extension(const std::string& output, const char* extension, const char* kind);

/// The stats file that goes with `image`: `asked`, or beside it with the extension .stats.json. Called before the work
/// begins. Throws InputError when either file could not be written, or would replace the scene or the other one. The
/// same where the image's name does not end in .exr.
std::string checked_stats_path(const std::string& asked, const std::string& image, const std::string& scene);
/// The same for an image of another format, whose name the caller has checked.
std::string stats_path_beside(const std::string& asked, const std::string& image, const std::string& scene);

/// The exit code of `run`, or 3 with the reason on stderr's last line when another engine cannot express the scene.
int refusing_with_3(const std::function<int()>& run);

/// Exit code of a verb whose engine did not finish for a reason other than the scene.
constexpr int failed_engine_exit_code = 70;

/// The exit code of `run`; or, with a line on stderr, 130 when an interrupt ended the engine before anything was
/// written, and failed_engine_exit_code when it failed.
int interruptibly(const std::function<int()>& run);

}  // namespace photonproof::inline harness_verbs
