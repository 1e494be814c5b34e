// Finds steps in a short, noisy series: seeded binary segmentation (Kovacs, Buehlmann, Li and Munk 2023, "Seeded binary
// segmentation: a general methodology for fast and optimal changepoint detection", Biometrika 110). Values count by
// their deviation from the median, bounded at three deviations (Huber 1964), so a single outlier makes no step. A step
// is kept if permutations of its segment exceed its statistic rarely enough (Phipson and Smyth 2010, "Permutation
// P-values should never be zero": p = (exceeding + 1) / (permutations + 1)).
//
// Symbols: a cut of an interval leaves n1 and n2 values with means m1 and m2. The statistic is the largest
// |m1 - m2| sqrt(n1 n2 / (n1 + n2)) over all intervals and cuts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace photonproof::inline harness_history {

struct ChangePointOptions {
  /// Largest probability of any step in a series whose values are exchangeable, such as independent noise around one
  /// mean. Each part of a series with steps has this probability again.
  double significance = 0.001;
  int permutations = 4999;
  std::uint64_t seed = 1;
  /// Values on either side of a step, at least.
  std::size_t least_side = 3;
  /// Longer series are searched by the medians of neighbours, and the step is then placed among their values.
  std::size_t most_values = 512;
};

/// The index of the first value of each new level, ascending. Preconditions: values are finite. The result depends on
/// nothing else: the permutations come from the seed.
std::vector<std::size_t> change_points(std::span<const double> values, const ChangePointOptions& options = {});

/// Whether most neighbours of the series are the same number, as errors of a program that renders the same bits are.
/// Such a series has no noise.
bool repeats_exactly(std::span<const double> values);

/// The index of each value that differs from the one before it.
std::vector<std::size_t> exact_changes(std::span<const double> values);

}  // namespace photonproof::inline harness_history
