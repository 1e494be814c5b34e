// The excess of a guess, against the definition in comparison.h pixel by pixel, and against pictures made here.
#include "harness/diagnosis/pictures/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "harness/diagnosis/pictures/arranged_totals.h"
#include "harness/diagnosis/pictures/picture_changes.h"

namespace photonproof::inline harness_diagnosis_pictures {
namespace {

constexpr double kTolerance = 0.08;

/// A gradient with noise and some unknown pixels.
Image speckled(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<float>(0.01 + 0.9 * static_cast<double>(i) / static_cast<double>(image.rgb.size()) +
                                      0.2 * std::uniform_real_distribution<double>()(random));
  image.rgb[40] = std::numeric_limits<float>::quiet_NaN();
  image.rgb[101] = std::numeric_limits<float>::infinity();
  return image;
}

std::vector<std::uint8_t> every_seventh(const Image& image) {
  std::vector<std::uint8_t> ignored(image.pixels());
  for (std::size_t i = 0; i < ignored.size(); i += 7) ignored[i] = 1;
  return ignored;
}

double compared_value(const Comparison& comparison, const Image& image, int x, int y, int c) {
  const float v = image.pixel(x, y)[c];
  const std::size_t pixel = static_cast<std::size_t>(y * image.width + x);
  return comparison.counts(pixel) && std::isfinite(v) ? comparison.shown(double{v})
                                                      : std::numeric_limits<double>::quiet_NaN();
}

/// Half the mean square of differences between neighbours, in a block with a pixel around it.
template <class Value>
double neighbours_variance(const Image& size, int bx, int by, const Value& value) {
  double sum = 0;
  int count = 0;
  for (int y = std::max(0, by - 1); y < std::min(size.height - 1, by + 5); ++y)
    for (int x = std::max(0, bx - 1); x < std::min(size.width - 1, bx + 5); ++x)
      for (const double d : {value(x + 1, y) - value(x, y), value(x, y + 1) - value(x, y)})
        if (std::isfinite(d)) sum += d * d / 2, ++count;
  return count > 0 ? sum / count : 0;
}

double brute_total(const Comparison& comparison, const Image& guess) {
  double total = 0, compared = 0, all = 0;
  for (int by = 0; by < guess.height; by += 4)
    for (int bx = 0; bx < guess.width; bx += 4)
      for (int c = 0; c < 3; ++c, ++all) {
        const auto seen = [&](int x, int y) { return compared_value(comparison, comparison.submitted(), x, y, c); };
        const auto apart = [&](int x, int y) { return seen(x, y) - compared_value(comparison, guess, x, y, c); };
        double sum = 0, level = 0, count = 0;
        for (int y = by; y < std::min(by + 4, guess.height); ++y)
          for (int x = bx; x < std::min(bx + 4, guess.width); ++x) {
            if (!std::isfinite(apart(x, y))) continue;
            sum += apart(x, y), level += compared_value(comparison, guess, x, y, c), ++count;
          }
        if (count < 4) continue;
        ++compared;
        const double variance =
            std::min(neighbours_variance(guess, bx, by, seen), neighbours_variance(guess, bx, by, apart));
        const double allowed = 3 * std::sqrt(2.5 * variance / count) + kTolerance / 2 * level / count +
                               0.5 / 255 / (2 * std::max(level / count, 0.06)) + 0.004;
        const double over = std::max(0.0, std::abs(sum / count) - allowed);
        total += over * over;
      }
  return total * all / compared;
}

TEST(Comparison, leaves_what_blocks_differ_by_beyond_their_allowance) {
  for (const auto& [width, height] : {std::pair{21, 14}, std::pair{16, 16}, std::pair{5, 33}}) {
    const Image submitted = speckled(width, height, 1);
    const Comparison comparison(submitted, 1.0f, kTolerance, every_seventh(submitted));
    Image guess = speckled(width, height, 2);
    for (float& v : guess.rgb) v *= 0.5f;
    const double expected = brute_total(comparison, guess);
    EXPECT_GT(expected, 0.01);
    EXPECT_NEAR(comparison.total(guess), expected, 1e-5 * expected);
    EXPECT_EQ(comparison.total(guess, 1.0001 * expected), comparison.total(guess));
    EXPECT_EQ(comparison.total(guess, 0.9999 * expected), INFINITY);
  }
}

// Tests all of the thousand combinations.
TEST(ArrangedTotals, are_those_of_the_pictures) {
  const Image submitted = speckled(18, 18, 3), picture = speckled(18, 18, 4);
  const Comparison comparison(submitted, 1.0f, kTolerance, every_seventh(submitted));
  ArrangedTotals totals(picture, comparison);
  for (std::size_t tone = 0; tone < tone_rows().size(); ++tone) {
    totals.encode(tone);
    for (std::size_t turn = 0; turn < turn_rows().size(); ++turn)
      for (std::size_t channels = 0; channels < channel_rows().size(); ++channels) {
        const Image made =
            toned(with_channels(turned(picture, turn_rows()[turn]), channel_rows()[channels]), tone_rows()[tone], 1);
        ASSERT_EQ(totals.total(turn, channels, INFINITY), comparison.total(made))
            << turn << ' ' << channels << ' ' << tone;
      }
  }
}

}  // namespace
}  // namespace photonproof::inline harness_diagnosis_pictures
