// Agreement must pass images of one expectation and fail others: measured over many pairs of noise whose law is known.
#include "harness/agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "scenes/input_error.h"

namespace photonproof {
namespace {

using Generator = std::mt19937_64;
/// One sample of a pixel whose expectation is 1, in units of it; the channels are the same.
using Noise = std::function<double(Generator&)>;
/// What a pixel should show.
using Scene = std::function<double(int x, int y)>;

double no_noise(Generator&) { return 1; }
double gaussian(Generator& g) { return std::normal_distribution<double>(1, 0.5)(g); }
double exponential(Generator& g) { return std::exponential_distribution<double>(1)(g); }
/// exp of a normal variable of deviation 1.5: the largest of a thousand samples is a hundred times their mean.
double lognormal(Generator& g) { return std::exp(std::normal_distribution<double>(-1.125, 1.5)(g)); }
/// Half the light comes in samples that are one in 200: an image by path tracing of a small bright caustic.
double fireflies(Generator& g) { return 0.5 + (std::uniform_real_distribution<double>(0, 1)(g) < 0.005 ? 100.0 : 0.0); }

/// Mean of `estimates` samples and the variance of that mean, pixel by pixel, as a film keeps them.
Rendering render(int size, int estimates, const Scene& scene, const Noise& noise, std::uint64_t seed) {
  Generator g(seed);
  Rendering image{Image(size, size), Image(size, size), {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double sum = 0, squares = 0;
      for (int i = 0; i < estimates; ++i) {
        const double sample = scene(x, y) * noise(g);
        sum += sample;
        squares += sample * sample;
      }
      const double variance = (squares - sum * sum / estimates) / (estimates - 1) / estimates;
      for (int c = 0; c < 3; ++c) {
        image.mean.pixel(x, y)[c] = static_cast<float>(sum / estimates);
        image.variance->pixel(x, y)[c] = static_cast<float>(std::max(0.0, variance));
      }
    }
  return image;
}

/// A disc brighter than what is around it, and a gradient over both.
double picture(int x, int y) { return (std::hypot(x - 12, y - 14) < 7 ? 2.0 : 0.5) * (1 + 0.02 * x); }

struct Failures {
  int pixels = 0, blocks = 0;
};
constexpr int kPairs = 300;

Failures failures_of_equal_pairs(int estimates, const Noise& a, const Noise& b) {
  Failures failures;
  for (std::uint64_t pair = 0; pair < kPairs; ++pair) {
    const Agreement result = test_agreement(render(24, estimates, picture, a, 2 * pair + 1),
                                            render(24, estimates, picture, b, 2 * pair + 2));
    failures.pixels += result.pixels.pass ? 0 : 1;
    failures.blocks += result.blocks.pass ? 0 : 1;
  }
  return failures;
}

TEST(agreement, holds_its_level_whatever_the_noise) {
  // At alpha = 0.01 the number of false alarms in 300 pairs is binomial with mean 3; 10 or more have probability 0.001.
  struct Case {
    const char* name;
    int estimates;
    Noise a, b;
  };
  for (const Case& c : {Case{"gaussian", 16, gaussian, gaussian},
                        {"exponential", 16, exponential, exponential},
                        {"exponential and exact", 16, exponential, no_noise},
                        {"gaussian", 64, gaussian, gaussian},
                        {"exponential and exact", 64, exponential, no_noise},
                        {"lognormal", 64, lognormal, lognormal},
                        {"lognormal and exact", 64, lognormal, no_noise},
                        {"fireflies", 64, fireflies, fireflies}}) {
    const Failures failures = failures_of_equal_pairs(c.estimates, c.a, c.b);
    std::printf("%d estimates, %s: %d and %d false alarms of %d\n", c.estimates, c.name, failures.pixels,
                failures.blocks, kPairs);
    EXPECT_LT(failures.pixels, 10) << c.name << " " << c.estimates;
    EXPECT_LT(failures.blocks, 10) << c.name << " " << c.estimates;
  }
}

TEST(agreement, holds_its_level_where_one_image_may_miss_what_the_other_knows_exactly) {
  // 64 estimates a pixel meet 0.32 fireflies, 20 a block: most pixels saw none and look certain of half the light.
  const Failures failures = failures_of_equal_pairs(64, fireflies, no_noise);
  std::printf("fireflies and exact: %d and %d false alarms of %d\n", failures.pixels, failures.blocks, kPairs);
  EXPECT_LT(failures.pixels, 10);
  EXPECT_LT(failures.blocks, 10);
}

TEST(agreement, finds_two_percent_of_energy) {
  // 64 samples of deviation 0.5 leave 6 % a pixel, sqrt(2) 6 % / 8 = 1.1 % a block of a difference: 2 % on each of 64
  // blocks are 1.8 deviations, chi^2 64 (1 + 3.3) against the bound 94. No pixel alone can show it.
  const auto darker = [](int x, int y) { return 0.98 * picture(x, y); };
  for (std::uint64_t seed = 1; seed < 20; seed += 2) {
    const Agreement result =
        test_agreement(render(64, 64, picture, gaussian, seed), render(64, 64, darker, gaussian, seed + 1));
    EXPECT_FALSE(result.blocks.pass) << result.blocks.sentence;
    EXPECT_FALSE(result.pass());
  }
}

TEST(agreement, finds_a_shift_by_one_pixel) {
  const auto shifted = [](int x, int y) { return picture(x - 1, y); };
  const Agreement result = test_agreement(render(32, 256, picture, gaussian, 1), render(32, 256, shifted, gaussian, 2));
  EXPECT_FALSE(result.pixels.pass) << result.pixels.sentence;
}

TEST(agreement, finds_one_wrong_pixel_and_says_where) {
  const auto with_dot = [](int x, int y) { return x == 5 && y == 9 ? 2 * picture(x, y) : picture(x, y); };
  const Agreement result =
      test_agreement(render(24, 256, picture, gaussian, 1), render(24, 256, with_dot, gaussian, 2));
  EXPECT_FALSE(result.pixels.pass);
  EXPECT_EQ(result.pixels.sentence.find("pixel (5, 9) "), 0u) << result.pixels.sentence;
  EXPECT_EQ(result.pixels.n, 3u * 24 * 24);
  // 1 - 0.99^(1/1728) = 5.816e-6, whose two-sided normal quantile is 4.533.
  EXPECT_NEAR(result.pixels.alpha, 5.816e-6, 1e-9);
  EXPECT_NEAR(result.pixels.bound, 4.533, 1e-3);
}

TEST(agreement, tells_pixels_without_noise_apart_but_not_by_rounding) {
  const Rendering exact = render(16, 2, picture, no_noise, 1);
  Rendering other = exact;
  for (float& value : other.mean.rgb) value *= 1 + 1e-6f;
  EXPECT_TRUE(test_agreement(exact, other).pass());
  other.mean.pixel(3, 4)[1] *= 1.001f;
  EXPECT_FALSE(test_agreement(exact, other).pixels.pass);
  const Rendering black = render(
      16, 2, [](int, int) { return 0.0; }, no_noise, 1);
  EXPECT_TRUE(test_agreement(black, black).pass());
}

TEST(agreement, needs_variances) {
  Rendering with = render(8, 2, picture, gaussian, 1), without = with;
  without.variance.reset();
  EXPECT_THROW(test_agreement(with, without), InputError);
  EXPECT_THROW(test_agreement(without, with), InputError);
}

}  // namespace
}  // namespace photonproof
