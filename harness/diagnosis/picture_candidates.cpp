#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "harness/diagnosis/guess.h"
#include "harness/diagnosis/pictures/arranged_totals.h"
#include "harness/diagnosis/pictures/picture_changes.h"

namespace photonproof::inline harness_diagnosis {
namespace {

class PictureCandidates {
 public:
  PictureCandidates(const Guess& guess, const Comparison& comparison, double left, std::vector<Candidate>& candidates)
      : guess_(guess), comparison_(comparison), left_(left), candidates_(candidates) {}

  /// Changes one property: the turn, the channels or the values. It keeps all combinations that explain nearly all of
  /// the difference, and the best of the others.
  void add_combinations() {
    std::vector<Combination> combinations = combinations_now();
    const Image picture = predicted(arranged(0, 0, 0), comparison_.white());
    ArrangedTotals totals(picture, comparison_);
    for (std::size_t tone = 0; tone < tone_rows().size(); ++tone) {
      totals.encode(tone);
      for (Combination& c : combinations)
        if (c.tone == tone) c.left = totals.total(c.turn, c.channels, left_);
    }
    std::array<double, 4> least;  // by number of changed properties
    least.fill(left_);
    for (const Combination& c : combinations) least[c.changed] = std::min(least[c.changed], c.left);
    for (const Combination& c : combinations)
      if (c.left <= nearly_all * left_ || c.left == least[c.changed]) add_combination(c);
  }

  void add_scale() {
    if (guess_.scale != 1) return;
    Guess best = guess_;
    double left = 1e30;
    const auto look = [&](double scale) {
      Guess other = guess_;
      other.scale = scale;
      const double now = comparison_.total(predicted(other, comparison_.white()), left);
      if (now < left) {
        left = now;
        best = other;
      }
    };
    for (double scale = 1.0 / 16; scale <= 16; scale *= 1.25) look(scale);
    const double coarse_best = best.scale;
    for (const double by : {0.85, 0.9, 0.95, 1.05, 1.1, 1.18}) look(coarse_best * by);
    const double factor = best.scale;
    if (std::abs(factor - 1) < 0.08) return;
    Finding finding{"exposure",
                    "the image is " + factor_text(factor) + " times as bright as it should be",
                    cause_of_scale(factor),
                    {},
                    0};
    // A smaller factor is as often one part of the light that is too dark or too bright.
    constexpr double least_named = 1.7;
    candidates_.push_back({.guess = std::move(best),
                           .left = left,
                           .handicap = 1.14,
                           .findings = {finding},
                           .named = std::max(factor, 1 / factor) > least_named});
  }

  void add_views() {
    if (guess_.shift_x != 0 || guess_.shift_y != 0 || guess_.zoom != 1) return;
    Guess best = guess_;
    double left = 1e30;
    const auto look = [&](double dx, double dy, double zoom) {
      Guess other = guess_;
      other.shift_x = dx;
      other.shift_y = dy;
      other.zoom = zoom;
      const double now = comparison_.total(predicted(other, comparison_.white()), left);
      if (now < left) {
        left = now;
        best = std::move(other);
      }
    };
    const double step = comparison_.width() / 32.0;
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx) look(dx * step, dy * step, 1);
    refine_shift(best, look);
    for (const double pixel : {-1.0, -0.5, 0.5, 1.0}) {
      look(pixel, 0, 1);
      look(0, pixel, 1);
      look(pixel, pixel, 1);
    }
    push_shift(best, left);
    left = 1e30;
    for (double zoom = 0.3; zoom <= 3.4; zoom *= 1.05) look(0, 0, zoom);
    const double found = best.zoom;
    for (const double by : {0.97, 0.985, 1.015, 1.03}) look(0, 0, found * by);
    push_zoom(best, left);
  }

  /// Pixels stored in rows of a different length than they are read in, from the first row on or from the last.
  void add_strides() {
    if (guess_.turn + guess_.channels + guess_.tone != 0 || comparison_.height() < 16) return;
    for (const int longer : {-4, -3, -2, -1, 1, 2, 3, 4})
      for (const bool from_last : {false, true}) {
        Guess other = guess_;
        other.light = restrided(guess_.light, longer, from_last);
        const int by = std::abs(longer);
        push(other, 1.15,
             {"slanted",
              "the image is slanted: each row lies " + std::to_string(by) + (by == 1 ? " pixel" : " pixels") +
                  " further " + (longer < 0 ? "right" : "left") + " than the one above",
              "rows are stored with another length than they are read with: width, or padding to 4 bytes",
              {},
              0});
      }
  }

  void add_sharpness() {
    if (guess_.blur > 0) return;
    for (const double blur : {1.0, 2.0, 3.0, 5.0}) {
      Guess other = guess_;
      other.blur = blur;
      push(other, 1.05,
           {"blurred", "the image is blurred", "filtered too widely, or rendered smaller and enlarged", {}, 0});
    }
  }

 private:
  /// Adds the candidate unless it is useless.
  void push(const Guess& guess, double handicap, const Finding& finding, bool local = false) {
    constexpr double useless = 2;  // times what is left without it
    const double left = comparison_.total(predicted(guess, comparison_.white()), useless * left_);
    if (std::isfinite(left))
      candidates_.push_back(
          {.guess = guess, .left = left, .handicap = handicap, .findings = {finding}, .local = local});
  }

  struct Combination {
    std::size_t turn, channels, tone, changed;
    double left;
  };

  std::vector<Combination> combinations_now() const {
    std::vector<Combination> combinations;
    for (std::size_t turn = 0; turn < turn_rows().size(); ++turn) {
      if (turn_rows()[turn].swaps_sides && comparison_.width() != comparison_.height()) continue;
      for (std::size_t channels = 0; channels < channel_rows().size(); ++channels)
        for (std::size_t tone = 0; tone < tone_rows().size(); ++tone) {
          const std::size_t changed =
              std::size_t{turn != guess_.turn} + (channels != guess_.channels) + (tone != guess_.tone);
          const bool says =
              is_named(turn, guess_.turn) || is_named(channels, guess_.channels) || is_named(tone, guess_.tone);
          if (says && changed == 1) combinations.push_back({turn, channels, tone, changed, left_});
        }
    }
    return combinations;
  }

  /// The unchanged row 0 is no mistake.
  static bool is_named(std::size_t now, std::size_t before) { return now != before && now != 0; }

  Guess arranged(std::size_t turn, std::size_t channels, std::size_t tone) const {
    Guess guess = guess_;
    guess.turn = turn;
    guess.channels = channels;
    guess.tone = tone;
    return guess;
  }

  void add_combination(const Combination& c) {
    Candidate candidate{arranged(c.turn, c.channels, c.tone), c.left, std::pow(1.15, c.changed)};
    const auto say = [&](std::size_t now, std::size_t before, const auto& row) {
      if (is_named(now, before)) candidate.findings.push_back({row.kind, row.sentence, row.cause, {}, 0});
    };
    say(c.turn, guess_.turn, turn_rows()[c.turn]);
    say(c.channels, guess_.channels, channel_rows()[c.channels]);
    say(c.tone, guess_.tone, tone_rows()[c.tone]);
    candidates_.push_back(std::move(candidate));
  }

  static std::string cause_of_scale(double factor) {
    const std::array<std::pair<double, const char*>, 6> known{{
        {M_PI, "the 1/pi of the diffuse BRDF is missing"},
        {1 / M_PI, "light is divided by pi twice"},
        {2, "light is counted twice"},
        {0.5, "light is halved"},
        {4, "the lamp's size or the photons' number enters wrongly"},
        {0.25, "the lamp's size or the photons' number enters wrongly"},
    }};
    for (const auto& [value, words] : known)
      if (std::abs(std::log(factor / value)) < 0.1) return words;
    return "the lamp's power, the exposure or the samples' number enters wrongly";
  }

  template <class Look>
  static void refine_shift(const Guess& best, const Look& look) {
    const double x = std::round(best.shift_x), y = std::round(best.shift_y);
    for (double dy = -2; dy <= 2; dy += 0.5)
      for (double dx = -2; dx <= 2; dx += 0.5) look(x + dx, y + dy, 1);
  }

  void push_shift(const Guess& best, double left) {
    if (best.shift_x == 0 && best.shift_y == 0) return;
    candidates_.push_back({best, left, 1.15, {shift_finding(best.shift_x, best.shift_y)}});
  }

  void push_zoom(const Guess& best, double left) {
    if (std::abs(best.zoom - 1) < 0.015) return;
    const std::string words = best.zoom > 1 ? "too narrow" : "too wide";
    candidates_.push_back(
        {best,
         left,
         1.15,
         {{"field-of-view",
           "the field of view is " + words,
           "its angle is taken along the other side, as half or whole, or the camera stands elsewhere",
           {},
           0}}});
  }

  const Guess& guess_;
  const Comparison& comparison_;
  double left_;  ///< Excess that the guess leaves.
  std::vector<Candidate>& candidates_;
};

}  // namespace

void add_arrangements(const Guess& guess, const Comparison& comparison, double left,
                      std::vector<Candidate>& candidates) {
  PictureCandidates add(guess, comparison, left, candidates);
  add.add_combinations();
  add.add_strides();
}

void add_brightness(const Guess& guess, const Comparison& comparison, double left, std::vector<Candidate>& candidates) {
  PictureCandidates(guess, comparison, left, candidates).add_scale();
}

void add_views(const Guess& guess, const Comparison& comparison, double left, std::vector<Candidate>& candidates) {
  PictureCandidates add(guess, comparison, left, candidates);
  add.add_views();
  add.add_sharpness();
}

}  // namespace photonproof::inline harness_diagnosis
