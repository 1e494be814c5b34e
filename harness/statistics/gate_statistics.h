// The conclusion of a gate from its images so far: it fails, it passes, or it needs more images. Pure functions; the
// images come from gate_run.h.
//
// A gate looks up to `looks` times, each time at twice as many images as before. It may fail by chance with probability
// alpha over all its looks. Every look spends an equal part of alpha. The union bound then holds the total, however the
// looks depend on each other. With five looks that widens the bounds by a tenth against one look at the same alpha. It
// needs no assumption about few images, unlike alpha-spending by information (Lan and DeMets 1983). Within a look the
// tests share the look's part in the same way.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/metrics/metric_bounds.h"
#include "harness/statistics/deviations.h"
#include "harness/statistics/gate_tiles.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_statistics {

/// With fewer images no skewness is known, and skewed noise looks like an error.
inline constexpr int least_images = 3;

struct Judgement {
  std::optional<GateVerdict> verdict;  ///< Pass or fail; empty if more images are needed.
  std::string sentence;                ///< The place and kind of the failure, or why it is undecided.
  Estimate observed;                   ///< The judged deviation or metric, with the interval used.
  std::vector<FailingTile> tiles{};    ///< Set when it fails, worst first.
  /// Set when agreement passes: minimum detectable relative errors (probability 0.99) of the image and of a block.
  std::optional<double> would_see{}, would_see_in_a_block{};
  std::array<bool, 3> whole_off{}, blocks_off{};  ///< Set when agreement fails: the failing channels.
  /// When agreement does not fail: the failure that only possibly missing bright samples prevent. Mostly empty.
  std::string but_for_rare_samples{};
};

/// The minimum detectable errors that a passing agreement gate promises, with probability 0.99. `whole` is in one
/// channel of the whole image, `block` in a block of 8 x 8 pixels. Both are relative: to the channel's mean, and to the
/// block's mean or the channel's where the block is darker.
struct AgreementBounds {
  double whole = 0, block = 0;
};

/// Known errors that are no defect, relative as AgreementBounds are. They are subtracted; where there are any, pixels
/// are not judged.
struct AllowedError {
  double whole = 0, block = 0;
  bool is_none() const { return whole == 0 && block == 0; }
};

/// For engines whose expectation is the reference's. Fails when chance does not explain a deviation of a pixel, a
/// block, all blocks together (chi^2) or the whole image. Each has a fourth of `alpha`, with Sidak's level within.
/// Where an error is allowed pixels are not judged, and each has a third. Passes when none fails and the promise above
/// holds. Undecided, with the reason, where only possibly missing bright samples explain the deviation. Precondition:
/// least_images.
Judgement judge_agreement(const Deviations& deviations, const AgreementBounds& bounds, double alpha,
                          const AllowedError& allowed = {});

/// The means that judge_agreement judges: the weighed ones where they are known and no error is allowed, else the plain
/// ones. An allowed error is of the plain mean.
const std::array<Deviation, 3>& judged_means(const Deviations& deviations, const AllowedError& allowed);

/// Judges the whole image alone, as judge_agreement does: `whole_off` and `would_see`, with the verdict fail or pass.
Judgement judge_whole(const std::array<Deviation, 3>& whole, double alpha, const AllowedError& allowed = {});

/// A block's deviation beyond the allowed error and noise, in standard errors; 0 where judge_agreement accepts it.
BlockScore block_excess(const Deviations& deviations, double alpha, const AllowedError& allowed = {});

/// For engines with a known error. The relative deviation of the whole image (`block` false) or of every block (true)
/// must lie within +-bound, relative to the same means as AgreementBounds. Fails when the interval of one lies outside,
/// passes when all intervals lie inside; they hold together with probability 1 - alpha.
Judgement judge_bias(const Deviations& deviations, bool block, double bound, double alpha);

/// Judges the expectation of a metric of one image against a bound on the side `kind`, from its values for independent
/// images. Precondition: at least two values, finite.
Judgement judge_metric(const std::string& metric, std::span<const double> values, BoundKind kind, double bound,
                       double alpha);

}  // namespace photonproof::inline harness_statistics
