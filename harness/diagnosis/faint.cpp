#include "harness/diagnosis/faint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "harness/diagnosis/pictures/picture_changes.h"
#include "harness/diagnosis/sub_pixel_shift.h"

namespace photonproof::inline harness_diagnosis {
namespace {

struct Match {
  double amount = 0, deviations = 0;
  double explained = 0;  ///< Share of the squared difference beyond noise.
};

class Filter {
 public:
  Filter(const Guess& guess, const Comparison& comparison)
      : comparison_(comparison), now_(predicted(guess, comparison.white())) {}

  Match match(const Image& changed) const {
    double both = 0, change = 0, all = 0, count = 0;
    std::vector<std::pair<double, double>> loudest;  // the values with the largest products, and their parts of
                                                     // `change`
    for (std::size_t i = 0; i < now_.rgb.size(); ++i) {
      if (!comparison_.counts(i / 3)) continue;
      const double from = comparison_.shown(now_.rgb[i]);
      const double b = comparison_.shown(changed.rgb[i]) - from;
      const double d = comparison_.shown(comparison_.submitted().rgb[i]) - from;
      if (!std::isfinite(b) || !std::isfinite(d)) continue;
      const double w = 1 / comparison_.variance_at(i);
      both += w * b * d;
      change += w * b * b;
      loudest.emplace_back(w * b * d, w * b * b);
      all += w * d * d;
      count += 1;
    }
    // A single glint that another mistake removes may look like all of a feature's light.
    const auto glint = std::min(glint_values, loudest.size());
    std::partial_sort(loudest.begin(), loudest.begin() + static_cast<std::ptrdiff_t>(glint), loudest.end(),
                      [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
    for (std::size_t i = 0; i < glint; ++i) {
      both -= loudest[i].first;
      change -= loudest[i].second;
    }
    Match match;
    if (change < 1) return match;
    match.amount = both / change;
    match.deviations = match.amount * std::sqrt(change / shared);
    const double beyond = all - count;
    match.explained = beyond > 0 ? match.amount * match.amount * change / beyond : 1;
    return match;
  }

  /// Sum of the squared differences in units of noise, as far as they exceed 1.
  double beyond_noise(const std::vector<std::uint8_t>& pixels) const {
    double sum = 0;
    for (std::size_t i = 0; i < now_.rgb.size(); ++i) {
      if (!comparison_.counts(i / 3) || (!pixels.empty() && pixels[i / 3] == 0)) continue;
      const double d = comparison_.shown(comparison_.submitted().rgb[i]) - comparison_.shown(now_.rgb[i]);
      if (std::isfinite(d)) sum += std::max(0.0, d * d / comparison_.variance_at(i) - 1);
    }
    return sum;
  }

 private:
  static constexpr std::size_t glint_values = 12;
  static constexpr double shared = 3;  // noise of photon maps is shared by neighbours
  const Comparison& comparison_;
  Image now_;
};

struct Kind {
  bool any_amount = false;  ///< The amount of light may be wrong by any factor; else a mistake is fully there or not.
  bool placed = false;
  double deviations = 12;  ///< Least deviations for a finding.
};

/// The least deviations of fine patterns. Broad changes may have other reasons, but nothing else looks like the pattern
/// of waves. Right pictures had at most 2 deviations of it, and 5 of broad changes.
constexpr double of_fine_patterns = 8;

bool is_there(const Match& m, const Kind& kind) {
  const bool in_full = m.amount > 0.75 && m.amount < 1.35;
  return (in_full || (kind.any_amount && m.amount > 0.4)) && m.deviations > kind.deviations && m.explained > 0.05;
}

Image plus_change(const Image& light, const Image& change, double factor) {
  Image sum = light;
  for (std::size_t i = 0; i < sum.rgb.size(); ++i)
    sum.rgb[i] = std::max(0.0f, sum.rgb[i] + static_cast<float>(factor) * change.rgb[i]);
  return sum;
}

class FaintSearch {
 public:
  FaintSearch(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison)
      : guess_(guess), knowledge_(knowledge), comparison_(comparison), filter_(guess, comparison) {}

  /// Whether these pixels (empty: all) differ so far beyond noise that a mistake there could be found.
  bool could_be_found(const std::vector<std::uint8_t>& pixels) const { return filter_.beyond_noise(pixels) > 200; }

  void look_at_light() {
    const SceneLight& light = knowledge_.light.get();
    for (const FeatureProbe& probe : light.probes)
      for (const double factor : {-1.0, 1.0})
        look(with_light(plus_change(guess_.light, probe.light, factor), probe.feature),
             {true, probe.feature == "caustic"},
             [&](double x) { return feature_finding(probe.feature, std::max(0.0, 1 + factor * x)); });
    for (const WhatIf& formula : light.formulas) look_at_what_if(formula);
    for (const WhatIf& what_if : knowledge_.what_ifs)
      if (could_be_found(what_if.changes)) look_at_what_if(what_if);
  }

  void look_at_patterns() {
    for (const WhatIf& what_if : knowledge_.what_ifs) {
      if (what_if.fine) look_at_fine(what_if);
      if (what_if.only_there && could_be_found(what_if.changes)) look_at_what_if(what_if);
    }
  }

  void look_at_tones() {
    for (std::size_t tone = 1; tone < tone_rows().size() && guess_.tone == 0; ++tone) {
      const ToneRow& row = tone_rows()[tone];
      Guess other = guess_;
      other.tone = tone;
      look(std::move(other), {}, [&](double) { return Finding{row.kind, row.sentence, row.cause, {}, 0}; });
    }
  }

  void look_at_shift() {
    if (guess_.shift_x != 0 || guess_.shift_y != 0) return;
    const std::optional<SubPixelShift> shift = sub_pixel_shift(predicted(guess_, comparison_.white()), comparison_);
    if (!shift || shift->deviations * shift->deviations <= most_) return;
    most_ = shift->deviations * shift->deviations;
    Candidate candidate;
    candidate.guess = guess_;
    candidate.guess.shift_x = shift->x;
    candidate.guess.shift_y = shift->y;
    candidate.findings = {shift_finding(shift->x, shift->y)};
    candidate.findings[0].explained = shift->explained;
    best_ = std::move(candidate);
  }

  std::optional<Candidate> best() { return std::move(best_); }

 private:
  Guess with_light(Image light, const std::string& name) const {
    Guess other = guess_;
    other.light = std::move(light);
    other.used.push_back(name);
    return other;
  }

  void look_at_what_if(const WhatIf& what_if) {
    if (what_if.fine) return look_at_fine(what_if);
    const Image& model = knowledge_.model();
    if (what_if.image.get().rgb.size() != model.rgb.size()) return;
    look_at_change(what_if, change_of(what_if.image.get(), model), {what_if.rough});
  }

  /// Looks for the change itself, and as a photon map blurs it that gathers within 1/100 or 1/50 of the picture's
  /// width.
  void look_at_fine(const WhatIf& what_if) {
    const Image& change = what_if.fine->get();
    if (change.rgb.size() != guess_.light.rgb.size()) return;
    const Kind kind{false, false, of_fine_patterns};
    look_at_change(what_if, change, kind);
    for (const double part : {0.01, 0.02}) look_at_change(what_if, blurred(change, part * change.width), kind);
  }

  void look_at_change(const WhatIf& what_if, const Image& change, const Kind& kind) {
    look(with_light(plus_change(guess_.light, change, 1), what_if.kind), kind, [&](double) {
      return Finding{what_if.kind, what_if.sentence, what_if.cause, {}, 0};
    });
  }

  template <class Words>
  void look(Guess other, const Kind& kind, const Words& words) {
    const Match match = filter_.match(predicted(other, comparison_.white()));
    const double off = kind.any_amount ? 0.1 : std::abs(match.amount - 1);
    const double worth = match.deviations * match.deviations * (1 - off);
    if (!is_there(match, kind) || worth <= most_) return;
    most_ = worth;
    Candidate candidate;
    candidate.guess = std::move(other);
    candidate.findings = {words(match.amount)};
    candidate.findings[0].explained = std::min(1.0, match.explained);
    candidate.placed = kind.placed;
    candidate.local = true;
    best_ = std::move(candidate);
  }

  const Guess& guess_;
  const SceneKnowledge& knowledge_;
  const Comparison& comparison_;
  Filter filter_;
  std::optional<Candidate> best_;
  double most_ = 0;  ///< Square of the deviations, reduced where the amount is unusual.
};

}  // namespace

bool could_hide_a_mistake(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison) {
  constexpr double too_noisy = 0.03;  // above this, clamping removes the light of fireflies, as if it were missing
  return comparison.noise() <= too_noisy && FaintSearch(guess, knowledge, comparison).could_be_found({});
}

std::optional<Candidate> faint_mistake(const Guess& guess, const SceneKnowledge& knowledge,
                                       const Comparison& comparison) {
  FaintSearch search(guess, knowledge, comparison);
  search.look_at_tones();
  search.look_at_shift();
  search.look_at_light();
  return search.best();
}

std::optional<Candidate> faint_pattern(const Guess& guess, const SceneKnowledge& knowledge,
                                       const Comparison& comparison) {
  FaintSearch search(guess, knowledge, comparison);
  search.look_at_patterns();
  return search.best();
}

}  // namespace photonproof::inline harness_diagnosis
