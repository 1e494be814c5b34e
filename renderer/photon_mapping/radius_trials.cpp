#include "renderer/photon_mapping/radius_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace photonproof::inline renderer_photon_mapping {

const RadiusTrials::Trial& RadiusTrials::chosen(double emitted) const {
  constexpr double nearly = 1.2;
  double least = std::numeric_limits<double>::infinity();
  for (const Trial& trial : trials_) least = std::min(least, at_most(trial, emitted));
  return *std::ranges::find_if(trials_, [&](const Trial& trial) { return at_most(trial, emitted) <= nearly * least; });
}

std::optional<double> RadiusTrials::seen_exponent() const {
  constexpr double plainly = 4, octave = 2.01;  // doubt is one standard error
  constexpr int fewest = 3;
  double first = 0, count = 0, x = 0, y = 0, xx = 0, xy = 0;  // sums of logarithms
  for (const Trial& trial : trials_) {
    if (!(trial.squared_bias > plainly * trial.doubt)) continue;
    if (first == 0) first = trial.radius;
    if (trial.radius > octave * first) break;
    const double radius = std::log(trial.radius / first), bias = std::log(trial.squared_bias);
    count += 1, x += radius, y += bias, xx += radius * radius, xy += radius * bias;
  }
  if (count < fewest) return std::nullopt;
  return std::clamp((count * xy - x * y) / (count * xx - x * x), edge_exponent, smooth_exponent);
}

double RadiusTrials::best(double emitted) const {
  const double known = std::min(emitted, emitted_);
  return chosen(known).radius * std::pow(emitted / known, -1.0 / 6);
}

/// Few photons make the brightest neighbour brighter by chance, and light that leaks is small beside pixels far away.
/// So the error is the larger of both. (Relative to neighbours alone it was a ninth of the truth in a bright furnace.)
double RadiusTrials::error(double emitted) const {
  constexpr double unseen_exponent = 2;  // of leaks along edges, and of smooth light: n^(-1/2) is between
  const double known = std::min(emitted, emitted_);
  const Trial& trial = chosen(known);
  const auto after = [&](double noise, double bias, double p) {
    return (noise + std::max(bias, noise * 2 / p)) * std::pow(emitted / known, -p / (p + 2));
  };
  // A wider disc has no less bias: the least of theirs bounds it.
  double bias = trial.by_neighbours.squared_bias;
  for (const Trial& other : trials_)
    if (other.radius > trial.radius) bias = std::min(bias, other.by_neighbours.squared_bias);
  const double by_neighbours =
      after(trial.by_neighbours.variance * emitted_ / known, bias, seen_exponent().value_or(unseen_exponent));
  return std::max(after(variance(trial, known), trial.squared_bias, exponent()), by_neighbours);
}

}  // namespace photonproof::inline renderer_photon_mapping
