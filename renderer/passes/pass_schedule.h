// Cuts a render into passes over the whole image: short enough to show progress and to stop on time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "scenes/base/timer.h"

namespace photonproof::inline renderer_passes {

class PassSchedule {
 public:
  /// Ends after `total_samples` per pixel, or when `seconds` have passed; at least one pass is always made. No pass
  /// takes more than `longest` samples per pixel, nor more than 1 / `parts` of all before it.
  PassSchedule(std::int64_t total_samples, std::optional<double> seconds, std::int64_t longest = 64,
               std::int64_t parts = 1)
      : total_(total_samples), seconds_(seconds), longest_(longest), parts_(parts) {}

  /// Continues after another run of `seconds`: the next pass takes `samples` from sample `first` on. With 0 samples, it
  /// is the pass that follows.
  void resume(std::int64_t first, std::int64_t samples, double seconds) {
    done_ = first;
    begun_ = samples;
    seconds_before_ = seconds;
  }

  /// Samples per pixel of the next pass; 0 when the render is done.
  std::int64_t next() {
    if (begun_ > 0) return started(std::exchange(begun_, 0));
    if (!seconds_ || done_ == 0) return started(length_from(done_));
    const double per_sample = seconds_spent() / static_cast<double>(done_);
    const auto affordable = static_cast<std::int64_t>((*seconds_ - seconds_spent()) / per_sample);
    return started(std::clamp<std::int64_t>(affordable, 0, length_from(done_)));
  }

  /// Whether a render of this number of samples makes, from its start, a pass of `samples` from sample `first` on. With
  /// 0 samples, whether a pass ends there. A budget of seconds allows any pass, as its passes depend on time.
  bool makes_pass(std::int64_t first, std::int64_t samples) const {
    if (seconds_) return true;
    std::int64_t at = 0;
    while (at < first && at < total_) at += length_from(at);
    return at == first && (samples == 0 || samples == length_from(at));
  }

  std::int64_t samples_done() const { return done_; }
  double seconds_spent() const { return seconds_before_ + timer_.seconds(); }
  /// The fraction done when `part` of the latest pass is done.
  double fraction(std::int64_t pass_samples, double part) const {
    if (seconds_) return std::min(1.0, seconds_spent() / *seconds_);
    return (static_cast<double>(done_) - (1 - part) * static_cast<double>(pass_samples)) / static_cast<double>(total_);
  }

 private:
  /// Length of the pass from sample `done` on, where only samples end it.
  std::int64_t length_from(std::int64_t done) const {
    const std::int64_t wanted = std::min(std::max<std::int64_t>(1, done / parts_), longest_);
    return seconds_ ? wanted : std::min(total_ - done, wanted);
  }
  std::int64_t started(std::int64_t samples) {
    done_ += samples;
    return samples;
  }

  std::int64_t total_;
  std::optional<double> seconds_;
  std::int64_t longest_, parts_;
  std::int64_t done_ = 0;
  std::int64_t begun_ = 0;
  double seconds_before_ = 0;
  Timer timer_;
};

}  // namespace photonproof::inline renderer_passes
