#include "harness/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "harness/diagnosis/breakage.h"
#include "harness/diagnosis/common_causes.h"
#include "harness/diagnosis/dark_lamps.h"
#include "harness/diagnosis/faint.h"
#include "harness/diagnosis/guess.h"
#include "harness/diagnosis/pictures/comparison.h"
#include "harness/diagnosis/pictures/picture_changes.h"
#include "harness/diagnosis/places.h"
#include "harness/diagnosis/self_shadowing.h"
#include "harness/diagnosis/whole_picture.h"

namespace photonproof::inline harness_diagnosis {
namespace {

std::string size_text(const Image& image) { return std::to_string(image.width) + " x " + std::to_string(image.height); }

bool as_expected_size(const Image& submitted, const SceneKnowledge& knowledge, std::vector<Finding>& findings) {
  const Image& reference = knowledge.reference;
  if (submitted.width == reference.width && submitted.height == reference.height && submitted.pixels() > 0) return true;
  findings.push_back({"wrong-size",
                      "the image has " + size_text(submitted) + " pixels, not " + size_text(reference),
                      "the size asked for is not heeded",
                      {0, 0, submitted.width, submitted.height},
                      1});
  return false;
}

/// Whether the picture is nearer to another scene's than to this one's, by far.
std::optional<Finding> other_scene(const Comparison& comparison, const SceneKnowledge& knowledge, double own) {
  for (const auto& [name, image] : knowledge.other_images) {
    const double other = comparison.total(resized(image, comparison.width(), comparison.height()));
    if (other < 0.15 * own)
      return Finding{"other-scene",
                     "same image as " + name + "'s",
                     "the scene asked for is not heeded, or an image left from another run was taken",
                     {0, 0, comparison.width(), comparison.height()},
                     1 - other / own};
  }
  return std::nullopt;
}

/// A reference that was itself cut at white does not know how bright lamps are, which is what wraps around: our picture
/// of the scene does.
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
  /// `patience`: how much more than usual is taken for noise.
  Search(const Image& submitted, const SceneKnowledge& knowledge, const Comparison& comparison, double patience)
      : submitted_(submitted), knowledge_(knowledge), comparison_(comparison), patience_(patience) {
    guess_.light = knowledge.reference;
    at_first_ = comparison.excess(predicted(guess_, comparison.white()));
    before_ = left_ = at_first_.total;
  }

  double at_first() const { return before_; }
  /// Below this nothing stands out of noise.
  /// Pictures with so much noise that clamping takes from it are darker than they should be.
  double least() const {
    const double size = std::max(1.0, comparison_.across() * comparison_.down() / 324.0);
    return patience_ * size * (0.004 + 5 * std::max(0.0, comparison_.noise() - 0.015));
  }

  std::vector<Finding> run() {
    std::vector<Finding> findings;
    constexpr int most = 6;
    for (int round = 0; round < most && left_ > least() && (round == 0 || unexplained() > least()); ++round) {
      const std::vector<Candidate> candidates = candidates_of(round == 0);
      const Candidate* best = clearest_of(candidates);
      if (!best || best->left * best->handicap > 0.8 * left_) break;
      const std::string other = alternative(candidates, *best);
      accept(*best, findings);
      if (!other.empty()) findings.back().cause += "; or " + other;
    }
    if (findings.empty() && patience_ == 1) findings = faint();
    if (left_ > std::max(2 * least(), 0.25 * before_))
      findings.push_back(what_is_left());
    else if (!findings.empty())
      say_distorted_bodies(guess_, knowledge_, comparison_, findings);
    return findings;
  }

  /// At most one.
  std::vector<Finding> faint() {
    if (!could_hide_a_mistake(guess_, knowledge_, comparison_)) return {};
    guess_.light = unclamped(knowledge_);
    return accepted(faint_mistake(guess_, knowledge_, comparison_));
  }
  std::vector<Finding> pattern() { return accepted(faint_pattern(guess_, knowledge_, comparison_)); }

 private:
  const Candidate* best_of(const std::vector<Candidate>& candidates) const {
    const Candidate* best = nullptr;
    for (const Candidate& candidate : candidates)
      if (!best || score(candidate) < score(*best)) best = &candidate;
    return best;
  }

  /// The best; or, where several explain nearly all within the tolerance, one that is far nearer than it in units of
  /// noise: a picture that is brighter where it should be is also brighter as a whole.
  const Candidate* clearest_of(const std::vector<Candidate>& candidates) const {
    const Candidate* best = best_of(candidates);
    constexpr double far_nearer = 0.5;
    if (!best || best->left > nearly_all * left_) return best;
    const auto mismatch = [&](const Candidate& c) {
      return c.handicap * comparison_.mismatch(predicted(c.guess, comparison_.white()));
    };
    double least_mismatch = far_nearer * mismatch(*best);
    for (const Candidate& candidate : candidates) {
      if (candidate.left > nearly_all * left_) continue;
      const double now = mismatch(candidate);
      if (now >= least_mismatch) continue;
      least_mismatch = now;
      best = &candidate;
    }
    return best;
  }

  bool explain_all(const std::vector<Candidate>& candidates) const {
    const Candidate* best = best_of(candidates);
    return best && best->left < std::max(least(), 0.02 * before_);
  }

  /// What the light is made of, and how mistakes look, is rendered only where cheaper hypotheses leave something.
  std::vector<Candidate> candidates_of(bool first_round) {
    std::vector<Candidate> candidates;
    add_arrangements(guess_, comparison_, left_, first_round, candidates);
    if (first_round) {
      if (explain_all(candidates)) {  // within the tolerance, as another brightness may
        add_brightness(guess_, comparison_, left_, candidates);
        return candidates;
      }
      guess_.light = unclamped(knowledge_);
      candidates.clear();
      add_arrangements(guess_, comparison_, left_, true, candidates);
    }
    add_brightness(guess_, comparison_, left_, candidates);
    add_views(guess_, comparison_, left_, candidates);
    add_light_candidates(guess_, knowledge_, comparison_, candidates);
    add_missing_objects(guess_, knowledge_, comparison_, candidates);
    add_self_shadowing(guess_, knowledge_, comparison_, candidates);
    const Excess excess = comparison_.excess(predicted(guess_, comparison_.white()));
    add_what_ifs(guess_, knowledge_, comparison_, excess, false, candidates);
    constexpr double poorly = 0.4;
    if (const Candidate* best = best_of(candidates); best && best->left < poorly * left_) return candidates;
    add_wrong_bodies(guess_, knowledge_, comparison_, excess, candidates);
    add_what_ifs(guess_, knowledge_, comparison_, excess, true, candidates);
    return candidates;
  }

  double score(const Candidate& c) const { return (c.left + 0.002 * before_) * c.handicap; }

  /// What explains the picture as well as the best does, is said with its cause.
  std::string alternative(const std::vector<Candidate>& candidates, const Candidate& best) const {
    const Candidate* other = nullptr;
    for (const Candidate& c : candidates)
      if (c.handicap < 1.13 && c.said.size() == 1 && c.said[0].sentence != best.said[0].sentence &&
          c.said[0].kind != best.said[0].kind && c.left < std::max(1.5 * best.left, best.left + 0.03 * left_) &&
          (!other || score(c) < score(*other)))
        other = &c;
    return other && best.said.size() == 1 ? other->said[0].sentence : "";
  }

  std::vector<Finding> accepted(std::optional<Candidate> faint) {
    std::vector<Finding> findings;
    if (!faint) return findings;
    faint->left = std::min(left_, comparison_.total(predicted(faint->guess, comparison_.white())));
    accept(*faint, findings);
    return findings;
  }

  void accept(const Candidate& best, std::vector<Finding>& findings) {
    // What several changes explain together is shared evenly.
    const double share = (left_ - best.left) / std::max(before_, 1e-9) / static_cast<double>(best.said.size());
    const std::vector<double> weight = difference(guess_.light, best.guess.light);
    for (Finding finding : best.said) {
      finding.explained = std::max(finding.explained, share);
      finding.where = {0, 0, comparison_.width(), comparison_.height()};
      if (best.placed) {
        const std::string place =
            best.place.empty() ? place_of(weight, comparison_.width(), comparison_.height(), knowledge_) : best.place;
        if (!place.empty()) finding.sentence += " " + place;
      }
      if (best.local) finding.where = region_of(weight, comparison_.width(), comparison_.height());
      findings.push_back(std::move(finding));
    }
    guess_ = best.guess;
    left_ = best.left;
  }

  std::vector<double> difference(const Image& a, const Image& b) const {
    std::vector<double> weight(a.pixels());
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
      const double d = comparison_.shown(a.rgb[i]) - comparison_.shown(b.rgb[i]);
      weight[i / 3] += d * d;
    }
    return weight;
  }

  /// Nothing known explains it: where, and whether it is too dark or too bright.
  Finding what_is_left() const {
    const Image guess = predicted(guess_, comparison_.white());
    const Excess excess = comparison_.excess(guess);
    std::vector<double> weight(submitted_.pixels());
    double brighter = 0, all = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
      const int x = static_cast<int>(i % static_cast<std::size_t>(submitted_.width)),
                y = static_cast<int>(i / static_cast<std::size_t>(submitted_.width));
      const double block =
          excess.block[static_cast<std::size_t>(y / Comparison::side * comparison_.across() + x / Comparison::side)];
      if (block <= 0 || !comparison_.counts(i)) continue;
      weight[i] = block;
      for (std::size_t c = 0; c < 3; ++c) {
        const double d = comparison_.shown(submitted_.rgb[3 * i + c]) - comparison_.shown(guess.rgb[3 * i + c]);
        if (!std::isfinite(d)) continue;
        brighter += d * block;
        all += std::abs(d) * block;
      }
    }
    std::string sentence = "the image differs";
    if (brighter > 0.7 * all) sentence = "the image is too bright";
    if (brighter < -0.7 * all) sentence = "the image is too dark";
    const std::string place = place_of(weight, submitted_.width, submitted_.height, knowledge_);
    if (!place.empty()) sentence += " " + place;
    return {"differs", sentence, "", region_of(weight, submitted_.width, submitted_.height), left_ / before_};
  }

  /// What is left, block by block less a 25th of what there was at first: as much may be wrong with the explanation.
  double unexplained() const {
    const Excess now = comparison_.excess(predicted(guess_, comparison_.white()));
    double sum = 0;
    for (std::size_t i = 0; i < now.block.size(); ++i) sum += std::max(0.0, now.block[i] - 0.04 * at_first_.block[i]);
    return sum;
  }

  const Image& submitted_;
  const SceneKnowledge& knowledge_;
  const Comparison& comparison_;
  double patience_;
  Guess guess_;
  Excess at_first_;
  double before_ = 0, left_ = 0;
};

}  // namespace

std::vector<Finding> diagnose(const Image& submitted, const SceneKnowledge& knowledge) {
  std::vector<Finding> findings;
  if (!as_expected_size(submitted, knowledge, findings)) return findings;
  Breakage breakage = find_breakage(submitted, knowledge);
  if (breakage.hopeless) return breakage.findings;
  const Comparison comparison(submitted, knowledge.white, knowledge.tolerance, breakage.ignored);
  const bool fireflies = std::any_of(breakage.findings.begin(), breakage.findings.end(),
                                     [](const Finding& f) { return f.kind == "fireflies"; });
  Search search(submitted, knowledge, comparison, fireflies ? 6 : 1);  // they take their light from what is compared
  if (search.at_first() > search.least())
    if (std::optional<Finding> other = other_scene(comparison, knowledge, search.at_first())) return {*other};
  findings = search.run();
  if (findings.empty())
    if (std::optional<Finding> lamps = find_dark_lamps(submitted, knowledge)) findings.push_back(*lamps);
  if (std::optional<Finding> noise = find_noise(comparison, knowledge)) findings.push_back(*noise);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.explained > b.explained; });
  join_common_causes(knowledge, findings);
  const bool other_view = std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return (f.kind == "shifted" || f.kind == "field-of-view") && f.explained > 0.3;
  });
  // A narrow black strip then is what lies beside the scene.
  if (other_view)
    std::erase_if(breakage.findings, [](const Finding& f) { return f.kind == "unrendered" && f.explained < 0.12; });
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
