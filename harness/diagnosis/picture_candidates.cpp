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

  /// Turned, with other channels, other values, and all of it at once. Of a thousand those are kept that explain nearly
  /// all, and of those that change as many things the best.
  void add_combinations(bool first_round) {
    std::vector<Combination> combinations = combinations_now(first_round);
    const Image picture = predicted(arranged(0, 0, 0), comparison_.white());
    ArrangedTotals totals(picture, comparison_);
    for (std::size_t tone = 0; tone < tone_rows().size(); ++tone) {
      totals.encode(tone);
      for (Combination& c : combinations)
        if (c.tone == tone) c.left = totals.total(c.turn, c.channels, left_);
    }
    std::array<double, 4> least;  // by how many things change
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
    candidates_.push_back({std::move(best), left, 1.14, {finding}});
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

  /// Rows that show what other rows should, as when threads share where they are.
  void add_copied_rows() {
    if (guess_.turn + guess_.channels + guess_.tone != 0 || comparison_.height() < 16) return;
    const Image now = predicted(guess_, comparison_.white());
    const int height = comparison_.height();
    const std::vector<float> expected = comparison_.shown_of(now);
    std::vector<double> far_nearer;  // than the row that should be there
    for (int y = 0; y < height; ++y) far_nearer.push_back(0.4 * row_distance(expected, y, y));
    RowRun best;
    for (int by = 3 - height; by <= height - 3; ++by)
      if (std::abs(by) >= 3) best = std::max(best, longest_run(expected, far_nearer, by));
    if (best.rows < 3 || best.rows > height * 3 / 4) return;
    Guess other = guess_;
    const std::size_t row = static_cast<std::size_t>(now.width) * 3;
    for (int y = best.first; y < best.first + best.rows; ++y)
      std::copy_n(guess_.light.rgb.begin() + static_cast<std::ptrdiff_t>(row) * (y + best.by), row,
                  other.light.rgb.begin() + static_cast<std::ptrdiff_t>(row) * y);
    const auto rows = [&](int first) { return std::to_string(first + 1) + " to " + std::to_string(first + best.rows); };
    push(other, 1.1,
         {"rows-copied",
          "rows " + rows(best.first) + " repeat rows " + rows(best.first + best.by),
          "work is divided wrongly, or threads write a variable that they share (a race)",
          {},
          0},
         true);
  }

  /// Pixels that were stored in rows of another length than they are read in, from the first row on or from the last.
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
  struct RowRun {
    int rows = 0, first = 0, by = 0;
    bool operator<(const RowRun& other) const { return rows < other.rows; }
  };

  /// Of the submitted row y from an expected one, a value; not summed to the end where it is more than `most`.
  double row_distance(const std::vector<float>& expected, int y, int other, double most = INFINITY) const {
    const std::size_t values = 3 * static_cast<std::size_t>(comparison_.width());
    const float* const row = &comparison_.shown_of_submitted()[static_cast<std::size_t>(y) * values];
    const float* const from = &expected[static_cast<std::size_t>(other) * values];
    double sum = 0;
    for (std::size_t i = 0; i < values && sum <= most * static_cast<double>(values); ++i) {
      const double d = double{row[i]} - double{from[i]};
      if (std::isfinite(d)) sum += d * d;
    }
    return sum / static_cast<double>(values);
  }

  /// Of rows that are far nearer to what is expected this many rows below.
  RowRun longest_run(const std::vector<float>& expected, const std::vector<double>& far_nearer, int by) const {
    RowRun best, run{0, 0, by};
    for (int y = std::max(0, -by); y < comparison_.height() - std::max(0, by); ++y) {
      const double most = far_nearer[static_cast<std::size_t>(y)];
      const bool elsewhere = row_distance(expected, y, y + by, most) < most;
      if (elsewhere && run.rows++ == 0) run.first = y;
      if (!elsewhere) run.rows = 0;
      best = std::max(best, run);
    }
    return best;
  }

  /// What is no use is not pushed.
  void push(const Guess& guess, double handicap, const Finding& finding, bool local = false) {
    constexpr double useless = 2;  // times what is left without it
    const double left = comparison_.total(predicted(guess, comparison_.white()), useless * left_);
    if (std::isfinite(left))
      candidates_.push_back({.guess = guess, .left = left, .handicap = handicap, .said = {finding}, .local = local});
  }

  struct Combination {
    std::size_t turn, channels, tone, changed;
    double left;
  };

  std::vector<Combination> combinations_now(bool first_round) const {
    std::vector<Combination> combinations;
    for (std::size_t turn = 0; turn < turn_rows().size(); ++turn) {
      if (turn_rows()[turn].swaps_sides && comparison_.width() != comparison_.height()) continue;
      if (!first_round && turn != guess_.turn && guess_.turn != 0) continue;
      for (std::size_t channels = 0; channels < channel_rows().size(); ++channels)
        for (std::size_t tone = 0; tone < tone_rows().size(); ++tone) {
          const std::size_t changed =
              std::size_t{turn != guess_.turn} + (channels != guess_.channels) + (tone != guess_.tone);
          const bool says =
              is_said(turn, guess_.turn) || is_said(channels, guess_.channels) || is_said(tone, guess_.tone);
          if (says && (first_round || changed == 1)) combinations.push_back({turn, channels, tone, changed, left_});
        }
    }
    return combinations;
  }

  /// To have nothing done any more is no mistake.
  static bool is_said(std::size_t now, std::size_t before) { return now != before && now != 0; }

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
      if (is_said(now, before)) candidate.said.push_back({row.kind, row.sentence, row.cause, {}, 0});
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
    candidates_.push_back({best, left, 1.15, {words_of_shift(best.shift_x, best.shift_y)}});
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
  double left_;  ///< by the guess
  std::vector<Candidate>& candidates_;
};

}  // namespace

void add_arrangements(const Guess& guess, const Comparison& comparison, double left, bool first_round,
                      std::vector<Candidate>& candidates) {
  PictureCandidates add(guess, comparison, left, candidates);
  add.add_combinations(first_round);
  add.add_copied_rows();
  if (first_round) add.add_strides();
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
