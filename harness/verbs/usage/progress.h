// Progress of verbs on standard error: the option --progress. A line that rewrites itself has the rate and the time
// left. A log has the same as a line a minute, for files and CI. JSON is for programs: docs/guides/ci.md has its
// members.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "scenes/base/timer.h"

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs_usage {

/// Adds --progress with the values auto, line, log, json and none. `auto` is a line on a terminal, else a log.
void add_progress_option(CLI::App& verb, std::string& mode);
/// Adds --quiet, which makes the mode "none". It goes after --progress.
void add_quiet_option(CLI::App& verb, std::string& mode);

/// Steps of a whole. A total of 0 is unknown.
struct ProgressStep {
  double done = 0, total = 0;
  std::string phase{};
  std::string unit{};  ///< "cells": then a line has the rate of them. Empty: without one.
};

ProgressStep counted(std::size_t done, std::size_t total, std::string phase, std::string unit);
/// "[3/9] ", the number of a part before its name.
std::string numbered(std::size_t number, std::size_t total);

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
  static Mode mode_of(const std::string& name);

  /// Empty where the total is unknown, or too little is done to tell.
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
