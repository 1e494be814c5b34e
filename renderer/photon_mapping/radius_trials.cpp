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

double RadiusTrials::best(double emitted) const {
  const double known = std::min(emitted, emitted_);
  return chosen(known).radius * std::pow(emitted / known, -1.0 / 6);
}

double RadiusTrials::error(double emitted) const {
  const double known = std::min(emitted, emitted_);
  const Trial& trial = chosen(known);
  const double noise = variance(trial, known);
  return (noise + std::max(trial.squared_bias, noise / 2)) * std::pow(emitted / known, -2.0 / 3);
}

}  // namespace photonproof::inline renderer_photon_mapping
