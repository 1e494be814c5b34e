#include "harness/verbs/usage/progress.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "harness/verbs/usage/name_hints.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline harness_verbs_usage {
namespace {

constexpr double least_done = 0.002;  // before, an estimate would be noise
constexpr double seconds_between_logs = 60, seconds_between_objects = 0.5;

nlohmann::ordered_json or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string line_of(const nlohmann::ordered_json& object) {
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// "40 s", "3 min" or "1.5 h"
std::string duration_text(double seconds) {
  char text[48];
  if (seconds < 60)
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 3600)
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60);
  else
    std::snprintf(text, sizeof text, "%.1f h", seconds / 3600);
  return text;
}

}  // namespace

void add_progress_option(CLI::App& verb, std::string& mode) {
  verb.add_option("--progress", mode, "how to tell what goes on: auto is line on a terminal, else log, a line a minute")
      ->check(one_of({"auto", "line", "log", "json", "none"}))
      ->capture_default_str();
}

void add_quiet_option(CLI::App& verb, std::string& mode) {
  verb.add_flag_callback(
      "--quiet", [&mode] { mode = "none"; }, "the same as --progress none");
}

ProgressStep counted(std::size_t done, std::size_t total, std::string phase, std::string unit) {
  return {static_cast<double>(done), static_cast<double>(total), std::move(phase), std::move(unit)};
}

std::string numbered(std::size_t number, std::size_t total) {
  return "[" + std::to_string(number) + "/" + std::to_string(total) + "] ";
}

Progress::Progress(const std::string& mode, std::function<double()> seconds)
    : mode_(mode_of(mode)), seconds_(seconds ? std::move(seconds) : [this] { return timer_.seconds(); }) {}

Progress::Mode Progress::mode_of(const std::string& name) {
  if (name == "json") return Mode::json;
  if (name == "none") return Mode::none;
  if (name == "auto") return isatty(STDERR_FILENO) != 0 ? Mode::line : Mode::log;
  return name == "line" ? Mode::line : Mode::log;
}

void Progress::at(const ProgressStep& step) {
  if (mode_ == Mode::none) return;
  const std::lock_guard lock(writing_);
  const double now = seconds_();
  if (!first_done_) {
    first_done_ = step.done;
    first_seconds_ = now;
  }
  switch (mode_) {
    case Mode::line:
      std::fprintf(stderr, "\r%s\033[K", text(step).c_str());
      on_screen_ = true;
      break;
    case Mode::log:
      if (now - written_at_ < seconds_between_logs) return;
      std::fprintf(stderr, "%s\n", text(step).c_str());
      break;
    default:
      if (any_written_ && now - written_at_ < seconds_between_objects) return;
      write_json(step);
  }
  std::fflush(stderr);
  any_written_ = true;
  written_at_ = now;
}

void Progress::say(const std::string& line) {
  if (mode_ == Mode::none) return;
  const std::lock_guard lock(writing_);
  if (mode_ == Mode::json)
    std::fprintf(stderr, "%s\n", line_of({{"seconds", seconds_()}, {"message", printable(line)}}).c_str());
  else
    std::fprintf(stderr, "%s%s\n", on_screen_ ? "\r\033[K" : "", printable(line).c_str());
  std::fflush(stderr);
  on_screen_ = false;
}

void Progress::clear() {
  const std::lock_guard lock(writing_);
  if (on_screen_) std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  on_screen_ = false;
}

std::function<void(double, const std::string&)> Progress::callback() {
  if (mode_ == Mode::none) return {};
  return [this](double fraction, const std::string& phase) {
    if (fraction < 1)
      at({fraction, 1, phase});
    else
      clear();
  };
}

std::optional<double> Progress::seconds_left(const ProgressStep& step) const {
  if (step.total <= 0) return std::nullopt;
  const double done = step.done - *first_done_, left = step.total - step.done;
  if (done < least_done * step.total || left < 0) return std::nullopt;
  return (seconds_() - first_seconds_) * left / done;
}

std::string Progress::text(const ProgressStep& step) const {
  std::string words = printable(step.phase);
  if (step.total <= 0) return words;
  char number[64], rate[64] = "";
  if (step.unit.empty()) {
    std::snprintf(number, sizeof number, "%3.0f %% ", 100 * step.done / step.total);
  } else {
    std::snprintf(number, sizeof number, "[%.0f/%.0f] ", step.done, step.total);
    const double seconds = seconds_() - first_seconds_, done = step.done - *first_done_;
    if (done > 0 && seconds > 0) std::snprintf(rate, sizeof rate, ", %.2g %s/s", done / seconds, step.unit.c_str());
  }
  const std::optional<double> left = seconds_left(step);
  return number + words + rate + (left && *left > 0 ? ", " + duration_text(*left) + " left" : "");
}

void Progress::write_json(const ProgressStep& step) {
  const bool known = step.total > 0;
  const nlohmann::ordered_json object = {
      {"seconds", seconds_()},
      {"done", step.unit.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(std::llround(step.done))},
      {"total", step.unit.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(std::llround(step.total))},
      {"fraction", known ? or_null(step.done / step.total) : or_null(std::nullopt)},
      {"seconds_left", or_null(seconds_left(step))},
      {"phase", printable(step.phase)}};
  std::fprintf(stderr, "%s\n", line_of(object).c_str());
}

}  // namespace photonproof::inline harness_verbs_usage
