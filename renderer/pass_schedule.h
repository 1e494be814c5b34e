// Cuts a render into passes over the whole image: short enough to show progress and to stop on time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "renderer/timer.h"

namespace photonproof {

class PassSchedule {
 public:
  /// Ends after `total_samples` a pixel, or when `seconds` are used up; at least one pass is always made. No pass takes
  /// more than `longest` samples a pixel.
  PassSchedule(std::int64_t total_samples, std::optional<double> seconds, std::int64_t longest = 64)
      : total_(total_samples), seconds_(seconds), longest_(longest) {}

  /// Samples a pixel of the next pass; 0 when the render is done.
  std::int64_t next() {
    if (done_ == 0) return started(1);
    if (!seconds_) return started(std::min<std::int64_t>({total_ - done_, done_, longest_}));
    const double per_sample = timer_.seconds() / static_cast<double>(done_);
    const auto affordable = static_cast<std::int64_t>((*seconds_ - timer_.seconds()) / per_sample);
    return started(std::clamp<std::int64_t>(affordable, 0, std::min(done_, longest_)));
  }
  std::int64_t samples_done() const { return done_; }
  double fraction() const {
    return seconds_ ? std::min(1.0, timer_.seconds() / *seconds_)
                    : static_cast<double>(done_) / static_cast<double>(total_);
  }

 private:
  std::int64_t started(std::int64_t samples) {
    done_ += samples;
    return samples;
  }

  std::int64_t total_;
  std::optional<double> seconds_;
  std::int64_t longest_;
  std::int64_t done_ = 0;
  Timer timer_;
};

}  // namespace photonproof
