#include "harness/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "harness/diagnosis/breakage.h"
#include "harness/diagnosis/dark_lights.h"
#include "harness/diagnosis/faint.h"
#include "harness/diagnosis/guess.h"
#include "harness/diagnosis/pictures/comparison.h"
#include "harness/diagnosis/pictures/picture_changes.h"
#include "harness/diagnosis/places.h"

namespace photonproof::inline harness_diagnosis {
namespace {

std::string size_text(const Image& image) { return std::to_string(image.width) + " x " + std::to_string(image.height); }

bool as_expected_size(const Image& submitted, const SceneKnowledge& knowledge, std::vector<Finding>& findings) {
  const Image& reference = knowledge.reference;
  if (submitted.width == reference.width && submitted.height == reference.height && submitted.pixels() > 0) return true;
  findings.push_back({"wrong-size",
                      "the image has " + size_text(submitted) + " pixels, not " + size_text(reference),
                      "the size asked for is ignored",
                      {0, 0, submitted.width, submitted.height},
                      1});
  return false;
}

/// A finding if the picture is another scene's picture up to noise. `own`: the excess over this scene's picture.
std::optional<Finding> other_scene(const Comparison& comparison, const SceneKnowledge& knowledge, double own,
                                   double least) {
  for (const auto& [name, image] : knowledge.other_images) {
    const double other = comparison.total(resized(image, comparison.width(), comparison.height()));
    if (other < std::min(least, 0.15 * own))
      return Finding{"other-scene",
                     "same image as " + name + "'s",
                     "the scene asked for is ignored, or an image left from another run was taken",
                     {0, 0, comparison.width(), comparison.height()},
                     1 - other / own};
  }
  return std::nullopt;
}

/// A reference cut at white does not hold how bright lights are, which decides how they wrap around. Our own picture of
/// the scene does.
Image unclamped(const SceneKnowledge& knowledge) {
  Image light = knowledge.reference;
  const Image& model = knowledge.light.get().model;
  if (!knowledge.white || model.rgb.size() != light.rgb.size()) return light;
  for (std::size_t i = 0; i < light.rgb.size(); ++i)
    if (light.rgb[i] > 0.999f * *knowledge.white) light.rgb[i] = std::max(light.rgb[i], model.rgb[i]);
  return light;
}

class Search {
 public:
  /// `patience`: the factor by which more deviation than usual counts as noise.
  Search(const Image& submitted, const SceneKnowledge& knowledge, const Comparison& comparison, double patience)
      : submitted_(submitted), knowledge_(knowledge), comparison_(comparison), patience_(patience) {
    guess_.light = knowledge.reference;
    at_first_ = comparison.excess(predicted(guess_, comparison_.white()));
    left_ = at_first_.total;
  }

  double at_first() const { return left_; }
  /// The excess below which a picture agrees up to noise. Clamping darkens very noisy pictures, so it rises with noise.
  double least() const {
    const double size = std::max(1.0, comparison_.across() * comparison_.down() / 324.0);
    return patience_ * size * (0.004 + 5 * std::max(0.0, comparison_.noise() - 0.015));
  }

  /// One explanation, or "differs"; empty where the picture agrees up to noise.
  std::vector<Finding> run() {
    if (left_ <= least()) return patience_ == 1 ? faint() : std::vector<Finding>{};
    const std::vector<Candidate> candidates = candidates_now();
    const std::optional<Candidate> best = convincing(candidates);
    return best ? explained_by(*best) : std::vector{unexplained(excess_weight())};
  }

  /// Finds a mistake that blocks do not show, but never names it: several look alike so close to noise.
  std::vector<Finding> faint() {
    if (!could_hide_a_mistake(guess_, knowledge_, comparison_)) return {};
    guess_.light = unclamped(knowledge_);
    return unnamed(faint_mistake(guess_, knowledge_, comparison_));
  }
  std::vector<Finding> pattern() { return unnamed(faint_pattern(guess_, knowledge_, comparison_)); }

 private:
  /// Probes and pictures with mistakes are rendered only where no turned picture explains everything. Exchanged
  /// channels do not suffice: in a grey room they look like exchanged walls.
  std::vector<Candidate> candidates_now() {
    std::vector<Candidate> candidates;
    add_arrangements(guess_, comparison_, left_, candidates);
    const auto best = std::min_element(candidates.begin(), candidates.end(),
                                       [](const Candidate& a, const Candidate& b) { return a.left < b.left; });
    if (best != candidates.end() && best->guess.turn > 0 && best->left < std::max(least(), 0.02 * left_))
      return candidates;
    guess_.light = unclamped(knowledge_);
    candidates.clear();
    add_arrangements(guess_, comparison_, left_, candidates);
    add_brightness(guess_, comparison_, left_, candidates);
    add_views(guess_, comparison_, left_, candidates);
    add_light_candidates(guess_, knowledge_, comparison_, candidates);
    const Excess excess = comparison_.excess(predicted(guess_, comparison_.white()));
    add_what_ifs(guess_, knowledge_, comparison_, excess, false, candidates);
    add_what_ifs(guess_, knowledge_, comparison_, excess, true, candidates);
    return candidates;
  }

  struct Fit {
    const Candidate* candidate;
    double mismatch;
  };

  /// The candidate that is nearest in units of noise, if it explains nearly all and no other is near it.
  std::optional<Candidate> convincing(const std::vector<Candidate>& candidates) const {
    std::vector<Fit> fits;
    for (const Candidate& c : candidates)
      if (c.left * c.handicap <= 2 * nearly_all * left_)
        fits.push_back({&c, c.handicap * comparison_.mismatch(predicted(c.guess, comparison_.white()))});
    const auto best =
        std::min_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.mismatch < b.mismatch; });
    if (best == fits.end() || best->mismatch > most_mismatch) return std::nullopt;
    if (best->candidate->left * best->candidate->handicap > nearly_all * left_) return std::nullopt;
    const bool has_rival = std::any_of(fits.begin(), fits.end(), [&](const Fit& other) {
      const bool near = other.mismatch < rival * best->mismatch || look_alike(*best->candidate, *other.candidate);
      return near && !says_all_of(*other.candidate, *best->candidate);
    });
    if (has_rival || !best->candidate->named) return std::nullopt;
    return *best->candidate;
  }

  /// In a grey room, exchanged channels look like exchanged walls. The walls are rendered, so they fit less well.
  static bool look_alike(const Candidate& best, const Candidate& other) {
    return best.findings.front().kind == "channels-swapped" && other.findings.front().kind == "walls-swapped";
  }

  /// Whether a candidate includes all findings of another: it is no rival, but the same with something added.
  static bool says_all_of(const Candidate& candidate, const Candidate& other) {
    return std::all_of(other.findings.begin(), other.findings.end(), [&](const Finding& wanted) {
      return std::any_of(candidate.findings.begin(), candidate.findings.end(), [&](const Finding& said) {
        return said.kind == wanted.kind && (!other.local || said.sentence == wanted.sentence);
      });
    });
  }

  std::vector<Finding> unnamed(const std::optional<Candidate>& faint) const {
    if (!faint) return {};
    Finding finding = unexplained(difference(guess_.light, faint->guess.light));
    finding.explained = 0;
    return {finding};
  }

  std::vector<Finding> explained_by(const Candidate& best) const {
    std::vector<Finding> findings = best.findings;
    const std::vector<double> weight = difference(guess_.light, best.guess.light);
    for (Finding& finding : findings) {
      // The share that several changes explain together is divided evenly.
      finding.explained = (left_ - best.left) / left_ / static_cast<double>(best.findings.size());
      finding.where = {0, 0, comparison_.width(), comparison_.height()};
      if (best.placed) {
        const std::string place = place_of(weight, comparison_.width(), comparison_.height(), knowledge_);
        if (!place.empty()) finding.sentence += " " + place;
      }
      if (best.local) finding.where = region_of(weight, comparison_.width(), comparison_.height());
    }
    return findings;
  }

  std::vector<double> difference(const Image& a, const Image& b) const {
    std::vector<double> weight(a.pixels());
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
      const double d = comparison_.shown(a.rgb[i]) - comparison_.shown(b.rgb[i]);
      weight[i / 3] += d * d;
    }
    return weight;
  }

  /// For each pixel, the difference of its block beyond noise.
  std::vector<double> excess_weight() const {
    std::vector<double> weight(submitted_.pixels());
    const std::size_t width = static_cast<std::size_t>(submitted_.width);
    for (std::size_t i = 0; i < weight.size(); ++i)
      if (comparison_.counts(i))
        weight[i] = at_first_.block[i / width / Comparison::side * static_cast<std::size_t>(comparison_.across()) +
                                    i % width / Comparison::side];
    return weight;
  }

  /// The place where the picture differs, and whether it is too dark or too bright there.
  Finding unexplained(const std::vector<double>& weight) const {
    const Image expected = predicted(guess_, comparison_.white());
    double brighter = 0, all = 0;
    for (std::size_t i = 0; i < expected.rgb.size(); ++i) {
      const double d = comparison_.shown(submitted_.rgb[i]) - comparison_.shown(expected.rgb[i]);
      if (!comparison_.counts(i / 3) || !std::isfinite(d)) continue;
      brighter += d * weight[i / 3];
      all += std::abs(d) * weight[i / 3];
    }
    std::string seen = brighter > 0.7 * all ? "too bright" : brighter < -0.7 * all ? "too dark" : "";
    const std::string place = place_of(weight, submitted_.width, submitted_.height, knowledge_);
    if (!place.empty()) seen += (seen.empty() ? "" : " ") + place;
    return {"differs", "differs here, not explained" + (seen.empty() ? "" : ": " + seen), "",
            region_of(weight, submitted_.width, submitted_.height), 1};
  }

  static constexpr double rival = 1.4;
  static constexpr double most_mismatch = 3;
  const Image& submitted_;
  const SceneKnowledge& knowledge_;
  const Comparison& comparison_;
  double patience_;
  Guess guess_;
  Excess at_first_;
  double left_ = 0;  ///< The excess that the guess leaves.
};

}  // namespace

std::vector<Finding> diagnose(const Image& submitted, const SceneKnowledge& knowledge) {
  std::vector<Finding> findings;
  if (!as_expected_size(submitted, knowledge, findings)) return findings;
  Breakage breakage = find_breakage(submitted, knowledge);
  if (breakage.hopeless) return breakage.findings;
  const Comparison comparison(submitted, knowledge.white, knowledge.tolerance, breakage.ignored);
  Search search(submitted, knowledge, comparison,
                breakage.has_fireflies ? 6 : 1);  // fireflies take their light from the compared pixels
  if (search.at_first() > search.least())
    if (std::optional<Finding> other = other_scene(comparison, knowledge, search.at_first(), search.least()))
      return {*other};
  findings = search.run();
  if (findings.empty() && breakage.findings.empty())
    if (std::optional<Finding> lights = find_dark_lights(submitted, knowledge)) findings.push_back(*lights);
  const bool other_view = std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return (f.kind == "shifted" || f.kind == "field-of-view") && f.explained > 0.3;
  });
  // A black strip then shows the scene's surroundings.
  if (other_view) std::erase_if(breakage.findings, [](const Finding& f) { return f.kind == "unrendered"; });
  // Enlarged pixels look shifted and blurred by themselves.
  const bool coarse = std::any_of(breakage.findings.begin(), breakage.findings.end(),
                                  [](const Finding& f) { return f.kind == "coarse"; });
  if (coarse) std::erase_if(findings, [](const Finding& f) { return f.kind == "shifted" || f.kind == "blurred"; });
  findings.insert(findings.begin(), breakage.findings.begin(), breakage.findings.end());
  return findings;
}

std::vector<Finding> find_hidden_mistake(const Image& submitted, const SceneKnowledge& knowledge) {
  std::vector<Finding> of_its_size;
  if (!as_expected_size(submitted, knowledge, of_its_size)) return {};
  if (!std::all_of(submitted.rgb.begin(), submitted.rgb.end(), [](float v) { return std::isfinite(v); })) return {};
  const Comparison comparison(submitted, knowledge.white, knowledge.tolerance, {});
  return Search(submitted, knowledge, comparison, 1).pattern();
}

}  // namespace photonproof::inline harness_diagnosis
