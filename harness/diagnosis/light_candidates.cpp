#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "harness/diagnosis/faint.h"
#include "harness/diagnosis/guess.h"
#include "harness/diagnosis/pictures/picture_changes.h"

namespace photonproof::inline harness_diagnosis {
namespace {

class LightCandidates {
 public:
  LightCandidates(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                  std::vector<Candidate>& candidates)
      : guess_(guess),
        knowledge_(knowledge),
        comparison_(comparison),
        light_(knowledge.light.get()),
        candidates_(candidates) {}

  void add_features() {
    for (const FeatureProbe& probe : light_.probes) {
      if (guess_.has(probe.feature)) continue;
      double most = 0;
      for (const float v : probe.light.rgb) most = std::max(most, double{v});
      if (most < 0.01) continue;
      Candidate best;
      double amount = 0;
      best.left = 1e30;
      const auto look = [&](double x) {
        Guess other = with_light(probe.light, x);
        const double left = left_of(other);
        if (left >= best.left) return;
        best.left = left;
        best.guess = std::move(other);
        amount = x;
      };
      for (const double x : {-1.0, -0.75, -0.5, -0.3, 0.5, 1.0, 2.0, M_PI - 1, 4.0}) look(x);
      const double found = amount;
      for (const double by : {-0.15, -0.08, 0.08, 0.15}) look(std::max(-1.0, found + by * (found > 1 ? 2 : 1)));
      best.guess.used.push_back(probe.feature);
      best.findings = {feature_finding(probe.feature, 1 + amount)};
      best.handicap = std::abs(amount + 1) < 0.1 || std::abs(amount - 1) < 0.1 ? 1.0 : 1.08;
      best.placed = probe.feature == "caustic";
      best.local = true;
      candidates_.push_back(std::move(best));
    }
    add_ambient();
  }

  void add_formulas() {
    for (const WhatIf& formula : light_.formulas) add_what_if(formula);
  }

  void add_what_ifs(const Excess& excess, bool rare) {
    for (const WhatIf& what_if : knowledge_.what_ifs)
      if (what_if.rare == rare && share_of_excess(what_if.changes, excess) >= (what_if.only_there ? 0.2 : 0.05))
        add_what_if(what_if);
  }

 private:
  void add_what_if(const WhatIf& what_if) {
    const Image& model = knowledge_.model();
    if (guess_.has(what_if.kind + what_if.landmark) || what_if.image.get().rgb.size() != model.rgb.size()) return;
    const Image difference = change_of(what_if.image.get(), model);
    for (const double amount : {1.0, 0.7}) {
      Candidate candidate;
      candidate.guess = with_light(difference, amount);
      candidate.guess.used.push_back(what_if.kind + what_if.landmark);
      candidate.left = left_of(candidate.guess);
      candidate.handicap = amount == 1 ? 1 : 1.25;
      candidate.findings = {{what_if.kind, what_if.sentence, what_if.cause, {}, 0}};
      candidate.local = true;
      candidates_.push_back(std::move(candidate));
    }
  }

  /// The share of the excess in these pixels' blocks. 1 where pixels are unknown, or the guess changes the view.
  double share_of_excess(const std::vector<std::uint8_t>& pixels, const Excess& excess) const {
    const bool as_seen = guess_.turn == 0 && guess_.shift_x == 0 && guess_.shift_y == 0 && guess_.zoom == 1;
    if (pixels.empty() || !as_seen) return 1;
    std::vector<std::uint8_t> inside(excess.block.size());
    const std::size_t width = static_cast<std::size_t>(comparison_.width());
    for (std::size_t i = 0; i < pixels.size(); ++i)
      if (pixels[i] != 0)
        inside[i / width / Comparison::side * static_cast<std::size_t>(comparison_.across()) +
               i % width / Comparison::side] = 1;
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      all += excess.block[i];
      sum += inside[i] * excess.block[i];
    }
    return all > 0 ? sum / all : 0;
  }

  double left_of(const Guess& guess) const { return comparison_.total(predicted(guess, comparison_.white())); }

  Guess with_light(const Image& light, double amount) const {
    Guess other = guess_;
    for (std::size_t i = 0; i < other.light.rgb.size(); ++i)
      other.light.rgb[i] = std::max(0.0f, other.light.rgb[i] + static_cast<float>(amount * light.rgb[i]));
    return other;
  }

  void add_ambient() {
    if (guess_.has("ambient")) return;
    Candidate best;
    best.left = 1e30;
    double level = 0;
    const auto look = [&](double x) {
      Guess other = guess_;
      for (float& v : other.light.rgb) v += static_cast<float>(x * comparison_.white());
      const double left = left_of(other);
      if (left >= best.left) return;
      best.left = left;
      best.guess = std::move(other);
      level = x;
    };
    for (const double x : {0.02, 0.04, 0.08, 0.16, 0.32}) look(x);
    const double coarse = level;
    for (const double by : {0.7, 0.8, 0.9, 1.1, 1.25, 1.4}) look(coarse * by);
    if (level < least_ambient) return;
    best.guess.used.push_back("ambient");
    best.handicap = 1.1;
    best.findings = {
        {"ambient", "everything is brighter by the same amount", "a constant ambient term is added", {}, 0}};
    candidates_.push_back(std::move(best));
  }

  static constexpr double least_ambient = 0.03;  ///< Fraction of white: less looks like lighter shadows.
  const Guess& guess_;
  const SceneKnowledge& knowledge_;
  const Comparison& comparison_;
  const SceneLight& light_;
  std::vector<Candidate>& candidates_;
};

}  // namespace

void add_light_candidates(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                          std::vector<Candidate>& candidates) {
  LightCandidates add(guess, knowledge, comparison, candidates);
  add.add_features();
  add.add_formulas();
}

void add_what_ifs(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                  const Excess& excess, bool rare, std::vector<Candidate>& candidates) {
  LightCandidates(guess, knowledge, comparison, candidates).add_what_ifs(excess, rare);
}

}  // namespace photonproof::inline harness_diagnosis
