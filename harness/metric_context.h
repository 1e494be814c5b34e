// What the metrics of one pair of images share, computed at the first use and kept: display encodings and error maps.
#pragma once

#include <optional>
#include <vector>

#include "harness/metrics.h"
#include "scenes/image.h"

namespace photonproof {

/// Refers to the images given, which must outlive it. Not safe to use from two threads at once.
class MetricContext {
 public:
  /// Precondition: find_defects(reference, test) is empty.
  MetricContext(const Image& reference, const Image& test, const MetricOptions& options)
      : reference_(reference), test_(test), options_(options) {}
  MetricContext(const MetricContext&) = delete;
  MetricContext& operator=(const MetricContext&) = delete;

  const Image& reference() const { return reference_; }
  const Image& test() const { return test_; }
  const MetricOptions& options() const { return options_; }

  /// Interleaved RGB in [0,1].
  struct DisplayPair {
    std::vector<double> reference, test;
  };
  const DisplayPair& exposed() const;  ///< scaled and clamped, still linear
  const DisplayPair& encoded() const;  ///< and sRGB-encoded

  const std::vector<float>& flip_map() const;          ///< see flip_map in metrics.h
  const std::vector<float>& flip_sorted() const;       ///< its values, ascending
  const std::vector<double>& relative_errors() const;  ///< see relmse_map in metrics.h

 private:
  const Image& reference_;
  const Image& test_;
  MetricOptions options_;
  mutable std::optional<DisplayPair> exposed_, encoded_;
  mutable std::optional<std::vector<float>> flip_map_, flip_sorted_;
  mutable std::optional<std::vector<double>> relative_errors_;
};

}  // namespace photonproof
