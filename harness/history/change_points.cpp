#include "harness/history/change_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "harness/statistics/statistics.h"
#include "scenes/base/splitmix.h"

namespace photonproof::inline harness_history {
namespace {

constexpr double deviations_of_mad = 1.4826;  // of a normal distribution: its deviation over its MAD
constexpr double most_deviations = 3;

double median_distance(std::span<const double> values, double from) {
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - from));
  return median_of(distances);
}

/// Deviations from the median, bounded. The scale is the larger of those of the values and of neighbours' differences,
/// so it is not 0 where a step makes most differences 0.
std::vector<double> bounded_scores(std::span<const double> values) {
  const double middle = median_of(values);
  std::vector<double> differences{0};
  for (std::size_t i = 1; i < values.size(); ++i) differences.push_back(values[i] - values[i - 1]);
  const double scale =
      deviations_of_mad * std::max(median_distance(values, middle), median_distance(differences, 0) / std::sqrt(2.0));
  std::vector<double> scores;
  for (const double value : values) {
    const double deviation = value - middle;
    scores.push_back(scale > 0 ? std::clamp(deviation / scale, -most_deviations, most_deviations) : deviation);
  }
  return scores;
}

/// Intervals of a length, evenly spaced, and the weight of a cut after k values.
struct Layer {
  std::size_t length = 0;
  std::vector<std::size_t> starts;
  std::vector<double> weights;
};

/// The seeded intervals: layer k has lengths n / sqrt(2)^(k-1), and 2 ceil(sqrt(2)^(k-1)) - 1 of them.
std::vector<Layer> seeded_layers(std::size_t count, std::size_t least_side) {
  std::vector<Layer> layers;
  for (int k = 0;; ++k) {
    const double parts = std::pow(std::sqrt(2.0), k);
    const auto length = static_cast<std::size_t>(std::ceil(static_cast<double>(count) / parts - 1e-9));
    if (length < 2 * least_side) return layers;
    if (!layers.empty() && layers.back().length == length) continue;
    Layer layer{length, {}, std::vector<double>(length)};
    const auto number = static_cast<std::size_t>(2 * std::ceil(parts - 1e-9)) - 1;
    for (std::size_t i = 0; i < number; ++i) {
      const std::size_t start = number == 1 ? 0 : (i * (count - length) + (number - 1) / 2) / (number - 1);
      if (layer.starts.empty() || layer.starts.back() != start) layer.starts.push_back(start);
    }
    const auto whole = static_cast<double>(length);
    for (std::size_t left = least_side; left + least_side <= length; ++left) {
      const auto part = static_cast<double>(left);
      layer.weights[left] = std::sqrt(whole / (part * (whole - part)));
    }
    layers.push_back(std::move(layer));
  }
}

struct Cut {
  double statistic = -1;
  std::size_t at = 0;  // first index of the new level
};

/// The cut with the largest statistic. |m1 - m2| sqrt(n1 n2 / n) equals |S1 - n1 S / n| sqrt(n / (n1 n2)) for sums S.
Cut best_cut(std::span<const double> scores, const std::vector<Layer>& layers, std::size_t least_side,
             std::vector<double>& sums) {
  sums.resize(scores.size() + 1);
  sums[0] = 0;
  std::partial_sum(scores.begin(), scores.end(), sums.begin() + 1);
  Cut best;
  for (const Layer& layer : layers)
    for (const std::size_t start : layer.starts) {
      const double mean = (sums[start + layer.length] - sums[start]) / static_cast<double>(layer.length);
      for (std::size_t left = least_side; left + least_side <= layer.length; ++left) {
        const double statistic =
            std::abs(sums[start + left] - sums[start] - mean * static_cast<double>(left)) * layer.weights[left];
        if (statistic > best.statistic) best = {statistic, start + left};
      }
    }
  return best;
}

/// The first value of the new level if the best cut of the segment is significant. Permutations end as soon as too many
/// exceed it (Besag and Clifford 1991, "Sequential Monte Carlo p-values").
std::optional<std::size_t> significant_cut(std::span<const double> values, const ChangePointOptions& options) {
  std::vector<double> scores = bounded_scores(values), sums;
  const std::vector<Layer> layers = seeded_layers(values.size(), options.least_side);
  if (layers.empty()) return std::nullopt;
  const Cut observed = best_cut(scores, layers, options.least_side, sums);
  if (!(observed.statistic > 0)) return std::nullopt;
  // Sums in another order differ in their last bits, and equal arrangements must count as exceeding.
  const double exceeded = observed.statistic * (1 - 1e-9);
  const double most = options.significance * (options.permutations + 1) - 1 + 1e-9;
  std::uint64_t drawn = 0;
  int exceeding = 0;
  for (int permutation = 0; permutation < options.permutations; ++permutation) {
    for (std::size_t i = scores.size() - 1; i > 0; --i)
      std::swap(scores[i], scores[splitmix64(options.seed, ++drawn) % (i + 1)]);
    if (best_cut(scores, layers, options.least_side, sums).statistic >= exceeded && ++exceeding > most)
      return std::nullopt;
  }
  return observed.at;
}

void cut_segment(std::span<const double> values, std::size_t first, const ChangePointOptions& options,
                 std::vector<std::size_t>& found) {
  const std::optional<std::size_t> cut = significant_cut(values, options);
  if (!cut) return;
  cut_segment(values.first(*cut), first, options, found);
  found.push_back(first + *cut);
  cut_segment(values.subspan(*cut), first + *cut, options, found);
}

/// Moves each step to the best cut between its neighbours, with their two levels alone.
void place_anew(std::span<const double> values, std::size_t least_side, std::vector<std::size_t>& steps) {
  std::vector<double> sums;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::size_t first = i == 0 ? 0 : steps[i - 1];
    const std::size_t end = i + 1 == steps.size() ? values.size() : steps[i + 1];
    std::vector<Layer> layers = seeded_layers(end - first, least_side);
    if (layers.empty()) continue;
    layers.resize(1);  // the whole
    steps[i] = first + best_cut(bounded_scores(values.subspan(first, end - first)), layers, least_side, sums).at;
  }
}

}  // namespace

std::vector<std::size_t> change_points(std::span<const double> values, const ChangePointOptions& options) {
  std::vector<std::size_t> found;
  if (values.size() < 2 * options.least_side) return found;
  const std::size_t together = (values.size() + options.most_values - 1) / options.most_values;
  if (together == 1) {
    cut_segment(values, 0, options, found);
  } else {
    std::vector<double> medians;
    for (std::size_t first = 0; first < values.size(); first += together)
      medians.push_back(median_of(values.subspan(first, std::min(together, values.size() - first))));
    cut_segment(medians, 0, options, found);
    for (std::size_t& step : found) step *= together;
  }
  place_anew(values, options.least_side, found);
  return found;
}

bool repeats_exactly(std::span<const double> values) {
  std::size_t equal = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] == values[i - 1]) ++equal;
  return values.size() > 1 && 2 * equal >= values.size() - 1;
}

std::vector<std::size_t> exact_changes(std::span<const double> values) {
  std::vector<std::size_t> found;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] != values[i - 1]) found.push_back(i);
  return found;
}

}  // namespace photonproof::inline harness_history
