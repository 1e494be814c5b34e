// The parts that verbs which render share: the progress line and the place of the stats.
#pragma once

#include <functional>
#include <string>

namespace photonproof::inline harness_verbs {

/// ", 40 s left", ", 3 min left" or ", 1.5 h left"; empty where too little is done to tell. The fraction `done` of the
/// work took `seconds`, and `left` remains.
std::string time_left(double seconds, double done, double left);

/// A line on standard error that rewrites itself; empty where standard error is no terminal, or `quiet`.
std::function<void(double fraction, const std::string& phase)> progress_line(bool quiet);

/// The stats file that goes with `image`: `asked`, or beside it with the extension .stats.json. Called before the work
/// begins: throws InputError when either file could not be written, or would replace the scene or the other one.
std::string checked_stats_path(const std::string& asked, const std::string& image, const std::string& scene);

/// The exit code of `run`, or 3 with the reason on stderr's last line when another engine cannot express the scene.
int refusing_with_3(const std::function<int()>& run);

/// Exit code of a verb whose engine did not finish for a reason other than the scene.
constexpr int failed_engine_exit_code = 70;

/// The exit code of `run`; or, with a line on stderr, 130 when an interrupt ended the engine before anything was
/// written, and failed_engine_exit_code when it failed.
int interruptibly(const std::function<int()>& run);

}  // namespace photonproof::inline harness_verbs
