#include "harness/diagnosis/faint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace photonproof {
namespace {

struct Match {
  double amount = 0, deviations = 0;
  double explained = 0;  ///< of the squared difference beyond noise
};

class Filter {
 public:
  Filter(const Guess& guess, const Comparison& comparison)
      : comparison_(comparison), now_(predicted(guess, comparison.white())) {}

  Match match(const Image& changed) const {
    double both = 0, change = 0, all = 0, count = 0;
    for (std::size_t i = 0; i < now_.rgb.size(); ++i) {
      if (!comparison_.counts(i / 3)) continue;
      const double from = comparison_.shown(now_.rgb[i]);
      const double b = comparison_.shown(changed.rgb[i]) - from;
      const double d = comparison_.shown(comparison_.submitted().rgb[i]) - from;
      if (!std::isfinite(b) || !std::isfinite(d)) continue;
      const double w = 1 / comparison_.variance_at(i);
      both += w * b * d;
      change += w * b * b;
      all += w * d * d;
      count += 1;
    }
    Match match;
    if (change < 1) return match;
    match.amount = both / change;
    match.deviations = match.amount * std::sqrt(change / shared);
    const double beyond = all - count;
    match.explained = beyond > 0 ? match.amount * match.amount * change / beyond : 1;
    return match;
  }

 private:
  static constexpr double shared = 3;  // noise of photon maps is shared by neighbours
  const Comparison& comparison_;
  Image now_;
};

/// A mistake is made or it is not; light may be too little or too much by any amount.
bool is_there(const Match& m, bool any_amount) {
  const bool in_full = m.amount > 0.75 && m.amount < 1.35;
  return (in_full || (any_amount && m.amount > 0.4)) && m.deviations > 12 && m.explained > 0.05;
}

Image plus_change(const Image& light, const Image& change, const Image& from, double factor) {
  Image sum = light;
  for (std::size_t i = 0; i < sum.rgb.size(); ++i)
    sum.rgb[i] = std::max(0.0f, sum.rgb[i] + static_cast<float>(factor) * (change.rgb[i] - from.rgb[i]));
  return sum;
}

}  // namespace

std::optional<Candidate> faint_mistake(const Guess& guess, const SceneKnowledge& knowledge,
                                       const Comparison& comparison) {
  constexpr double too_noisy = 0.02;  // clamping then takes what fireflies bring, as if light were missing
  if (comparison.noise() > too_noisy) return std::nullopt;
  const Filter filter(guess, comparison);
  std::optional<Candidate> best;
  double most = 0;
  const auto look = [&](const Image& light, const std::string& name, const auto& words, bool any_amount, bool placed) {
    Candidate candidate;
    candidate.guess = guess;
    candidate.guess.light = light;
    const Match match = filter.match(predicted(candidate.guess, comparison.white()));
    const double off = any_amount ? 0.1 : std::abs(match.amount - 1);
    const double worth = match.explained * (1 - off);
    if (!is_there(match, any_amount) || worth <= most) return;
    most = worth;
    candidate.guess.used.push_back(name);
    candidate.said = {words(match.amount)};
    candidate.placed = placed;
    candidate.local = true;
    best = std::move(candidate);
  };
  const Image& model = knowledge.model.rgb.empty() ? knowledge.reference : knowledge.model;
  const Image none(model.width, model.height);
  for (const FeatureProbe& probe : knowledge.probes)
    for (const double factor : {-1.0, 1.0})
      look(
          plus_change(guess.light, probe.light, none, factor), probe.feature,
          [&](double x) { return words_of_feature(probe.feature, std::max(0.0, 1 + factor * x)); }, true,
          probe.feature == "caustic");
  for (const WhatIf& what_if : knowledge.what_ifs)
    if (what_if.image.rgb.size() == model.rgb.size())
      look(
          plus_change(guess.light, what_if.image, model, 1), what_if.kind,
          [&](double) {
            return Finding{what_if.kind, what_if.sentence, what_if.cause, {}, 0};
          },
          false, false);
  return best;
}

}  // namespace photonproof
