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
      best.said = {words_of_feature(probe.feature, 1 + amount)};
      best.handicap = std::abs(amount + 1) < 0.1 || std::abs(amount - 1) < 0.1 ? 1.0 : 1.08;
      if (probe.feature == "later bounces") best.handicap *= 1.03;
      best.placed = probe.feature == "caustic";
      best.local = true;
      candidates_.push_back(std::move(best));
    }
    add_colourless_indirect();
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

  /// Each object's light times a factor of each channel, as the picture has it; only while the picture is not turned
  /// and its values are linear.
  void add_objects() {
    if (knowledge_.seen.size() != guess_.light.pixels() || guess_.turn + guess_.channels + guess_.tone != 0) return;
    const Image now = predicted(guess_, comparison_.white());
    for (std::size_t mark = 0; mark < knowledge_.landmarks.size(); ++mark) {
      const Landmark& landmark = knowledge_.landmarks[mark];
      if (guess_.has("object " + landmark.name)) continue;
      double submitted[3] = {}, expected[3] = {}, count = 0;
      for (std::size_t i = 0; i < now.pixels(); ++i) {
        if (knowledge_.seen[i] != mark + 1 || !comparison_.counts(i)) continue;
        count += 1;
        for (std::size_t c = 0; c < 3; ++c) {
          submitted[c] += std::min(comparison_.white(), double{comparison_.submitted().rgb[3 * i + c]});
          if (std::isfinite(now.rgb[3 * i + c]))
            expected[c] += std::min(comparison_.white(), double{now.rgb[3 * i + c]});
        }
      }
      if (count < 12) continue;
      add_object(mark, submitted, expected, count);
    }
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
      candidate.handicap = (amount == 1 ? 1 : 1.25) * handicap_of(what_if.kind);
      candidate.said = {{what_if.kind, what_if.sentence, what_if.cause, {}, 0}};
      candidate.local = true;
      candidates_.push_back(std::move(candidate));
    }
  }

  /// Of the blocks that these pixels lie in; 1 where they are unknown, or the guess is not how the scene is seen.
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

  /// Of mistakes that look like a more likely one: glass with its indices exchanged reflects nearly everything, and
  /// where a mirror is of glass what lies behind it is seen, as where it is missing.
  static double handicap_of(const std::string& kind) {
    return kind == "walls-swapped" ? 1.2 : kind == "glass-mirror" ? 1.12 : kind == "mirror-glass" ? 1.1 : 1;
  }

  double left_of(const Guess& guess) const { return comparison_.total(predicted(guess, comparison_.white())); }

  Guess with_light(const Image& light, double amount) const {
    Guess other = guess_;
    for (std::size_t i = 0; i < other.light.rgb.size(); ++i)
      other.light.rgb[i] = std::max(0.0f, other.light.rgb[i] + static_cast<float>(amount * light.rgb[i]));
    return other;
  }

  void add_colourless_indirect() {
    for (const FeatureProbe& probe : light_.probes) {
      if (probe.feature != "indirect" || guess_.has("colourless")) continue;
      Image change = probe.light;
      for (std::size_t i = 0; i < change.pixels(); ++i) {
        float* p = &change.rgb[3 * i];
        const float grey = (p[0] + p[1] + p[2]) / 3;
        for (std::size_t c = 0; c < 3; ++c) p[c] = grey - p[c];
      }
      Candidate candidate;
      candidate.guess = with_light(change, 1);
      candidate.guess.used.push_back("colourless");
      candidate.left = left_of(candidate.guess);
      candidate.handicap = 1.05;
      candidate.said = {{"bleeding-missing",
                         "indirect light has no colour: walls do not bleed",
                         "photons keep the lamp's colour when they bounce",
                         {},
                         0}};
      candidates_.push_back(std::move(candidate));
    }
  }

  void add_ambient() {
    if (guess_.has("ambient")) return;
    for (const double level : {0.03, 0.06, 0.12, 0.25}) {
      Candidate candidate;
      candidate.guess = guess_;
      for (float& v : candidate.guess.light.rgb) v += static_cast<float>(level * comparison_.white());
      candidate.guess.used.push_back("ambient");
      candidate.left = left_of(candidate.guess);
      candidate.handicap = 1.1;
      candidate.said = {
          {"ambient", "everything is brighter by the same amount", "a constant ambient term is added", {}, 0}};
      candidates_.push_back(std::move(candidate));
    }
  }

  void add_object(std::size_t mark, const double (&submitted)[3], const double (&expected)[3], double count) {
    double factor[3], least = 1e30, most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      factor[c] = submitted[c] / std::max(expected[c], 0.004 * count);
      least = std::min(least, factor[c]);
      most = std::max(most, factor[c]);
    }
    if (least > 0.88 && most < 1.14) return;
    const Landmark& landmark = knowledge_.landmarks[mark];
    Candidate candidate;
    candidate.guess = guess_;
    for (std::size_t i = 0; i < knowledge_.seen.size(); ++i)
      if (knowledge_.seen[i] == mark + 1)
        for (std::size_t c = 0; c < 3; ++c) candidate.guess.light.rgb[3 * i + c] *= static_cast<float>(factor[c]);
    candidate.guess.used.push_back("object " + landmark.name);
    candidate.left = left_of(candidate.guess);
    candidate.handicap = 1.3;
    candidate.local = true;
    const std::string name = "the " + landmark.name;
    Finding said{"object-brightness", "", "", {}, 0};
    if (most < 0.95 && most >= 0.05 && caustic_share(mark) > 0.3) {
      said = {"caustic-missing-on",
              "part of the caustics on " + name + " is missing: it is too dark",
              "light that mirrors, glass or water send there is left out, or stored elsewhere",
              {},
              0};
    } else if (most < 0.05) {
      said = {"object-black", name + " is black", "its normal points the wrong way, or nothing lights it", {}, 0};
    } else if (most > 1.25 * least && most - least > 0.15) {
      said = {"object-colour", name + " has the wrong colour", "its reflectance is not what the scene says", {}, 0};
    } else {
      const double mean = (factor[0] + factor[1] + factor[2]) / 3;
      said.sentence = name + " is " + factor_text(mean) + " times as bright as it should be";
      said.cause = "its reflectance, or the light that it gets, is wrong";
    }
    candidate.said = {said};
    candidates_.push_back(std::move(candidate));
  }

  /// Of an object's light.
  double caustic_share(std::size_t mark) const {
    double sum = 0, count = 0;
    for (const FeatureProbe& probe : light_.probes) {
      if (probe.feature != "caustic" || guess_.has(probe.feature)) continue;
      for (std::size_t i = 0; i < knowledge_.seen.size(); ++i)
        if (knowledge_.seen[i] == mark + 1) {
          sum += probe.weight[i];
          count += 1;
        }
    }
    return sum / std::max(1.0, count);
  }

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
  add.add_objects();
}

void add_what_ifs(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                  const Excess& excess, bool rare, std::vector<Candidate>& candidates) {
  LightCandidates(guess, knowledge, comparison, candidates).add_what_ifs(excess, rare);
}

}  // namespace photonproof::inline harness_diagnosis
