// What the verbs that render share: the progress line and where the stats go.
#pragma once

#include <functional>
#include <string>

namespace photonproof::inline harness_verbs {

/// ", 40 s left", ", 3 min left" or ", 1.5 h left" after `seconds` in which the fraction `done` of the work was done
/// and `left` remains; empty where too little is done to say.
std::string time_left(double seconds, double done, double left);

/// A line on standard error that rewrites itself; empty where standard error is no terminal, or `quiet`.
std::function<void(double fraction, const std::string& phase)> progress_line(bool quiet);

/// The stats file that goes with `image`: `asked`, or beside it with the extension .stats.json. Called before the work
/// begins: throws InputError when either file could not be written, or would replace the scene or the other one.
std::string checked_stats_path(const std::string& asked, const std::string& image, const std::string& scene);

/// The exit code of `run`, or 3 with the reason on stderr's last line when another engine cannot express the scene.
int refusing_with_3(const std::function<int()>& run);

/// Of a verb whose engine did not finish, which is not the scene's fault.
constexpr int failed_engine_exit_code = 70;

/// The exit code of `run`; or, with a line on stderr, 130 when an interrupt ended the engine before anything was
/// written, and failed_engine_exit_code when it failed.
int interruptibly(const std::function<int()>& run);

}  // namespace photonproof::inline harness_verbs
