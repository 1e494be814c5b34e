// How far a verb is and what ended, on standard error: the option --progress.
//   line   one line that rewrites itself, with the rate and the time left
//   log    the same as a line a minute, for files and CI
//   json   one JSON object a line, at most two a second: {"seconds", "done", "total", "fraction", "seconds_left",
//          "phase"}, where null is unknown, or {"seconds", "message"} for what ended
//   none   nothing
//   auto   line on a terminal, else log
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "scenes/base/timer.h"

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs_usage {

/// Adds --progress with the values auto, line, log, json and none.
void add_progress_option(CLI::App& verb, std::string& mode);

/// ", 40 s left", ", 3 min left" or ", 1.5 h left"; empty where too little is done to tell. The fraction `done` of the
/// work took `seconds`, and `left` remains.
std::string time_left(double seconds, double done, double left);

/// Steps of a whole. A total of 0 is unknown.
struct ProgressStep {
  double done = 0, total = 0;
  std::string phase{};
  std::string unit{};  ///< "cells": then a line has the rate of them. Empty: without one.
};

/// Its functions may be called on any thread.
class Progress {
 public:
  /// `mode` is a value of --progress. `seconds` is the time since the work began; empty: since now.
  explicit Progress(const std::string& mode, std::function<double()> seconds = {});
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void at(const ProgressStep& step);
  /// A line that stays, about a part that ended.
  void say(const std::string& line);
  /// Removes the line that rewrites itself.
  void clear();

  bool rewrites() const { return mode_ == Mode::line; }
  /// For work that tells a fraction; empty where nothing would be written. It refers to this object.
  std::function<void(double fraction, const std::string& phase)> callback();

 private:
  enum class Mode { line, log, json, none };

  std::optional<double> seconds_left(const ProgressStep& step) const;
  std::string text(const ProgressStep& step) const;
  void write_json(const ProgressStep& step);

  Mode mode_;
  Timer timer_;
  std::function<double()> seconds_;
  std::mutex writing_;
  std::optional<double> first_done_;  ///< where a resumed run began
  double first_seconds_ = 0, written_at_ = 0;
  bool any_written_ = false, on_screen_ = false;
};

}  // namespace photonproof::inline harness_verbs_usage
