// What a gate concludes from the images it has so far: it fails, it passes, or more images are needed. Pure functions;
// gate_run.h draws the images.
//
// A gate looks up to `looks` times, each time at twice as many images as before, and may fail by chance with
// probability alpha over all its looks. Every look spends an equal part of alpha, so that the union bound holds the
// total whatever looks have in common; with five looks that widens the bounds by a tenth against one look at the same
// alpha, and needs no assumption that alpha-spending by information (Lan and DeMets 1983) would need of few images.
// Within a look the tests share the look's part in the same way.
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

/// Of fewer no skewness is known, and noise that is skewed looks like an error.
inline constexpr int least_images = 3;

struct Judgement {
  std::optional<GateVerdict> verdict;  ///< pass or fail; empty: more images are needed
  std::string sentence;                ///< where and how, or why it is not decided
  Estimate observed;                   ///< the deviation or metric that was judged, with the interval it was judged by
  std::vector<FailingTile> tiles{};    ///< when it fails, worst first
  /// When agreement passes: the whole's and a block's relative error that would have been seen with probability 0.99.
  std::optional<double> would_see{}, would_see_in_a_block{};
  std::array<bool, 3> whole_off{}, blocks_off{};  ///< when agreement fails: channels that do
  /// When agreement does not fail: how it would, were it not for bright samples that may be missing. Mostly empty.
  std::string but_for_rare_samples{};
};

/// What an agreement gate promises when it passes: it would have failed with probability 0.99 were the whole image off
/// by `whole` in one channel, or a block of 8 x 8 pixels by `block`. Both relative: to the channel's mean, and to the
/// block's mean or the channel's where the block is darker.
struct AgreementBounds {
  double whole = 0, block = 0;
};

/// Errors that are known and no defect, relative as AgreementBounds are. They count for nothing; where there are any,
/// pixels are not judged.
struct AllowedError {
  double whole = 0, block = 0;
  bool is_none() const { return whole == 0 && block == 0; }
};

/// For engines whose expectation is the reference's. Fails when chance does not explain a deviation: of a pixel, a
/// block, all blocks together (chi^2) or the whole image. Each has a fourth of `alpha`, Sidak's level within. Where an
/// error is allowed pixels are not judged, and each has a third. Passes when none fails and the promise above holds.
/// Where it would fail but for bright samples that may be missing, it is undecided and says so. Precondition:
/// least_images.
Judgement judge_agreement(const Deviations& deviations, const AgreementBounds& bounds, double alpha,
                          const AllowedError& allowed = {});

/// The means that judge_agreement judges: weighed ones where they are known and no error is allowed, for one that is
/// allowed is of the plain mean.
const std::array<Deviation, 3>& judged_means(const Deviations& deviations, const AllowedError& allowed);

/// The whole image alone, as judge_agreement judges it: `whole_off` and `would_see`, with the verdict fail or pass.
Judgement judge_whole(const std::array<Deviation, 3>& whole, double alpha, const AllowedError& allowed = {});

/// A block's excess over what is allowed and noise explains, in standard errors; 0 where judge_agreement accepts it.
BlockScore block_excess(const Deviations& deviations, double alpha, const AllowedError& allowed = {});

/// For engines with a known error: the relative deviation of the whole image (`block` false) or of every block (true),
/// relative to what AgreementBounds says, must lie within +-bound. Fails when the interval of one lies outside, passes
/// when all intervals lie inside; they hold together with probability 1 - alpha.
Judgement judge_bias(const Deviations& deviations, bool block, double bound, double alpha);

/// The expectation of a metric of one image, from its values for independent images, against a bound on that side.
/// Precondition: at least two values, finite.
Judgement judge_metric(const std::string& metric, std::span<const double> values, BoundKind kind, double bound,
                       double alpha);

}  // namespace photonproof::inline harness_statistics
