// Agreement must pass images of equal expectation and fail others. Many pairs of noise with a known law measure this.
#include "harness/statistics/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "scenes/base/input_error.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_statistics {
namespace {

using Generator = std::mt19937_64;
/// One sample of a pixel whose expectation is 1, in units of it; the channels are the same.
using Noise = std::function<double(Generator&)>;
/// The expected value of a pixel.
using Scene = std::function<double(int x, int y)>;

double no_noise(Generator&) { return 1; }
/// Normal values come in pairs; the distribution keeps the second one. An image takes an even number of them.
double normal(Generator& g) {
  static std::normal_distribution<double> distribution;
  return distribution(g);
}
double gaussian(Generator& g) { return 1 + 0.5 * normal(g); }
double exponential(Generator& g) { return std::exponential_distribution<double>(1)(g); }
/// exp of a normal variable of deviation 1.5: the largest of a thousand samples is a hundred times their mean.
double lognormal(Generator& g) { return std::exp(1.5 * normal(g) - 1.125); }
/// Half the light comes in samples that are one in 200: an image by path tracing of a small bright caustic.
double fireflies(Generator& g) { return 0.5 + (std::uniform_real_distribution<double>(0, 1)(g) < 0.005 ? 100.0 : 0.0); }

/// Mean of `estimates` samples and the variance of that mean, pixel by pixel, as a film keeps them.
Rendering render(int size, int estimates, const Scene& scene, const Noise& noise, std::uint64_t seed) {
  Generator g(seed);
  Rendering image{Image(size, size), Image(size, size), {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double expected = scene(x, y);
      double sum = 0, squares = 0;
      for (int i = 0; i < estimates; ++i) {
        const double sample = expected * noise(g);
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

/// A disc brighter than its surroundings, and a gradient over both.
double picture(int x, int y) { return (std::hypot(x - 12, y - 14) < 7 ? 2.0 : 0.5) * (1 + 0.02 * x); }

struct Failures {
  int pixels = 0, blocks = 0, whole = 0, any = 0;
  void count(const Agreement& result) {
    pixels += result.pixels.pass ? 0 : 1;
    blocks += result.blocks.pass ? 0 : 1;
    whole += result.whole.pass ? 0 : 1;
    any += result.pass() ? 0 : 1;
  }
};
constexpr int kPairs = 300;

/// At alpha = 0.01 the false alarms in 300 pairs are binomial with mean 3 at most; 10 or more have probability 0.001.
/// For each of the three tests, at 0.00334, the mean is 1; 6 or more have probability 0.0006.
void expect_level(const Failures& failures, const char* name, int estimates) {
  std::printf("%d estimates, %s: %d, %d and %d false alarms, %d in all, of %d\n", estimates, name, failures.pixels,
              failures.blocks, failures.whole, failures.any, kPairs);
  EXPECT_LT(failures.pixels, 6) << name << " " << estimates;
  EXPECT_LT(failures.blocks, 6) << name << " " << estimates;
  EXPECT_LT(failures.whole, 6) << name << " " << estimates;
  EXPECT_LT(failures.any, 10) << name << " " << estimates;
}

Failures failures_of_equal_pairs(int estimates, const Noise& a, const Noise& b) {
  Failures failures;
  for (std::uint64_t pair = 0; pair < kPairs; ++pair) {
    failures.count(test_agreement(render(24, estimates, picture, a, 2 * pair + 1),
                                  render(24, estimates, picture, b, 2 * pair + 2)));
  }
  return failures;
}

TEST(agreement, holds_its_level_whatever_the_noise) {
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
    expect_level(failures_of_equal_pairs(c.estimates, c.a, c.b), c.name, c.estimates);
  }
}

TEST(agreement, holds_its_level_where_one_image_may_miss_what_the_other_knows_exactly) {
  // 64 estimates a pixel meet 0.32 fireflies, 20 a block: most pixels meet none and look certain of half the light.
  expect_level(failures_of_equal_pairs(64, fireflies, no_noise), "fireflies and exact", 64);
}

/// Multiplies all of the image by `factor`.
void scale(Rendering& image, double factor) {
  for (float& value : image.mean.rgb) value = static_cast<float>(factor * double{value});
  for (float& value : image.variance->rgb) value = static_cast<float>(factor * factor * double{value});
}

TEST(agreement, finds_an_error_as_large_as_it_says_it_would_have_seen) {
  // The promised probability is 0.99, in either direction. If it holds, 194 or fewer of 200 pairs are found with
  // probability 0.016. An error of nine tenths of the true size is found with probability 0.961; then 188 or fewer are
  // equally likely.
  struct Case {
    const char* name;
    Noise a, b;
  };
  for (const Case& c : {Case{"gaussian", gaussian, gaussian},
                        {"exponential", exponential, exponential},
                        {"exponential and exact", exponential, no_noise},
                        {"lognormal", lognormal, lognormal},
                        {"lognormal and gaussian", lognormal, gaussian},
                        {"fireflies", fireflies, fireflies}}) {
    constexpr int pairs = 200;
    int brighter = 0, darker = 0;
    double said = 0;
    for (std::uint64_t pair = 0; pair < pairs; ++pair) {
      const Rendering reference = render(24, 64, picture, c.a, 2 * pair + 1);
      Rendering test = render(24, 64, picture, c.b, 2 * pair + 2);
      const double size = test_agreement(reference, test).would_see.value();
      said += size / pairs;
      scale(test, 1 + size);
      brighter += test_agreement(reference, test).whole.pass ? 0 : 1;
      scale(test, (1 - size) / (1 + size));
      darker += test_agreement(reference, test).whole.pass ? 0 : 1;
    }
    std::printf("%s: +-%.2g %% found in %d and %d of %d\n", c.name, 100 * said, brighter, darker, pairs);
    EXPECT_GE(brighter, 194) << c.name;
    EXPECT_GE(darker, 194) << c.name;
  }
}

/// An image whose pixels all vary together: 32 passes, each with its own factor.
Rendering shared_passes(int size, double deviation, std::uint64_t seed) {
  Generator g(seed);
  constexpr int passes = 32;
  std::normal_distribution<double> factor(1, deviation);
  double sum = 0, squares = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const double f = factor(g);
    sum += f;
    squares += f * f;
  }
  const double mean = sum / passes, variance = (squares / passes - mean * mean) / (passes - 1);
  Rendering image{Image(size, size), Image(size, size), {}};
  double level = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      level += picture(x, y) / size / size;
      for (int c = 0; c < 3; ++c) {
        image.mean.pixel(x, y)[c] = static_cast<float>(mean * picture(x, y));
        image.variance->pixel(x, y)[c] = static_cast<float>(variance * picture(x, y) * picture(x, y));
      }
    }
  const double error = level * std::sqrt(variance);
  store_mean_error(image, {{error, error, error}, passes});
  return image;
}

TEST(agreement, takes_an_images_word_for_how_pixels_vary_together) {
  // The pixels alone state a standard error 24 times too small, and nearly every pair would be an alarm. With Student's
  // quantiles for twice 31 degrees of freedom its level and its power are exact: limits as above.
  int alarms = 0, found = 0, without = 0;
  constexpr int pairs = 1000;
  for (std::uint64_t pair = 0; pair < pairs; ++pair) {
    const Rendering reference = shared_passes(24, 0.1, 2 * pair + 1);
    Rendering test = shared_passes(24, 0.1, 2 * pair + 2);
    const Agreement result = test_agreement(reference, test);
    alarms += result.whole.pass ? 0 : 1;
    // sqrt(2/32) 0.1 = 2.5 % of the mean, times the quantiles 3.419 and 2.388, and more for brighter images: 15.7 %.
    if (pair < 10) {
      EXPECT_NEAR(result.would_see.value(), 0.157, 0.05);
    }
    Rendering silent = test;
    silent.metadata.clear();
    Rendering silent_reference = reference;
    silent_reference.metadata.clear();
    without += test_agreement(silent_reference, silent).whole.pass ? 0 : 1;
    Rendering brighter = test;
    scale(brighter, 1 + *result.would_see);
    found += test_agreement(reference, brighter).whole.pass ? 0 : 1;
  }
  std::printf("%d false alarms, %d without its word, %d found, of %d\n", alarms, without, found, pairs);
  // Three channels share one noise, so the level is 0.00112: 6 or more alarms of 1000 have probability 0.001.
  EXPECT_LT(alarms, 6);
  EXPECT_GT(without, 500);
  EXPECT_GE(found, 970);
}

/// Even light whose noise is spread over 3 x 3 pixels by 1/4, 1/2, 1/4 along either axis. A pixel has (3/8)^2 of the
/// spread variance; a sum over many pixels has all of it.
Rendering spread_noise(int size, std::uint64_t seed, bool says_so) {
  constexpr double deviation = 0.05, kernel[] = {0.25, 0.5, 0.25}, of_a_pixel = 9.0 / 64;
  Generator g(seed);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<double> white(static_cast<std::size_t>((size + 2) * (size + 2)));
  for (double& v : white) v = normal(g);
  Rendering image{Image(size, size), Image(size, size), {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double sum = 1;
      for (int j = 0; j < 9; ++j)
        sum += kernel[j / 3] * kernel[j % 3] * white[static_cast<std::size_t>((y + j / 3) * (size + 2) + x + j % 3)];
      for (int c = 0; c < 3; ++c) {
        image.mean.pixel(x, y)[c] = static_cast<float>(sum);
        image.variance->pixel(x, y)[c] = static_cast<float>(of_a_pixel * deviation * deviation);
      }
    }
  const double of_mean = deviation / size;
  store_mean_error(image, {{of_mean, of_mean, of_mean}, 64});
  if (says_so) store_pixels_a_splat(image, 1 / of_a_pixel);
  return image;
}

TEST(agreement, takes_an_images_word_for_how_neighbours_vary_together) {
  Failures failures;
  int unsaid = 0;
  for (std::uint64_t pair = 0; pair < kPairs; ++pair) {
    failures.count(test_agreement(spread_noise(24, 2 * pair + 1, true), spread_noise(24, 2 * pair + 2, true)));
    unsaid +=
        test_agreement(spread_noise(24, 2 * pair + 1, false), spread_noise(24, 2 * pair + 2, false)).pass() ? 0 : 1;
  }
  expect_level(failures, "noise over 3 x 3 pixels", 64);
  EXPECT_GT(unsaid, kPairs / 2);
}

// Neighbours vary together, as where they gather the same photons, and the image states only this. The block test
// rejects most of such pairs. Pixels and the plain mean, whose error the image states, keep their level.
TEST(agreement, of_images_whose_pixels_share_photons_is_by_pixels_and_the_whole_image) {
  const auto photons = [](std::uint64_t seed) {
    Rendering image = spread_noise(24, seed, false);
    store_shared_photons(image);
    return image;
  };
  Failures failures;
  int found = 0, told = 0;
  for (std::uint64_t pair = 0; pair < kPairs; ++pair) {
    const Rendering reference = photons(2 * pair + 1);
    Rendering test = photons(2 * pair + 2);
    const Agreement result = test_agreement(reference, test);
    ASSERT_TRUE(result.shared_noise);
    EXPECT_EQ(result.blocks.sentence, "not judged: pixels of an image share noise");
    failures.count(result);
    scale(test, 1 + *result.would_see);
    found += test_agreement(reference, test).whole.pass ? 0 : 1;
    told +=
        test_agreement(spread_noise(24, 2 * pair + 1, false), spread_noise(24, 2 * pair + 2, false), 0.01, true).pass()
            ? 1
            : 0;
  }
  expect_level(failures, "photons over 3 x 3 pixels", 64);
  EXPECT_GE(found, kPairs * 0.97) << "0.99, less three standard errors";
  EXPECT_EQ(told, kPairs - failures.any) << "the caller may know what the image does not say";
}

// Two images of 12 passes whose means are known to 0.01 each. The level of one channel is 0.00111608. Its two-sided
// quantile is 3.7468 for Student's t of 22 degrees of freedom and 3.2595 for the normal distribution.
TEST(agreement, of_shared_photons_knows_how_few_passes_its_standard_error_comes_from) {
  const auto image = [](double mean, double passes) {
    Rendering out{Image(16, 16), Image(16, 16), {}};
    for (float& v : out.mean.rgb) v = static_cast<float>(mean);
    for (float& v : out.variance->rgb) v = 1;
    store_mean_error(out, {{0.01, 0.01, 0.01}, passes});
    store_shared_photons(out);
    return out;
  };
  const double error = 0.01 * std::sqrt(2.0);
  const auto passes = [&](double deviations, double count) {
    return test_agreement(image(1, count), image(1 + deviations * error, count)).whole.pass;
  };
  EXPECT_TRUE(passes(3.70, 12));
  EXPECT_FALSE(passes(3.79, 12));
  EXPECT_TRUE(passes(3.22, 1e9));
  EXPECT_FALSE(passes(3.30, 1e9));
}

TEST(agreement, of_shared_noise_is_inconclusive_where_no_image_says_how_certain_its_mean_is) {
  Rendering reference = spread_noise(24, 1, false), test = spread_noise(24, 2, false);
  reference.metadata.clear();
  test.metadata.clear();
  const Agreement result = test_agreement(reference, test, 0.01, true);
  EXPECT_TRUE(result.inconclusive);
  EXPECT_FALSE(result.would_see);
  EXPECT_EQ(result.power_sentence(),
            "the image does not state the standard error of its mean, so no error could be detected");
  test.mean.pixel(3, 4)[1] += 1;  // 38 deviations
  const Agreement wrong = test_agreement(reference, test, 0.01, true);
  EXPECT_FALSE(wrong.pass());
  EXPECT_FALSE(wrong.inconclusive);
}

TEST(agreement, compares_blocks_without_what_all_pixels_are_high_by_together) {
  // The common part has five times the deviation of a pixel's own noise: 0.1 against 0.02. A block is tested against
  // the variance of both, as if pixels were independent: sqrt(2 (0.1^2 + 0.02^2)) / 8 = 1.8 %. Some 14 of these are
  // found.
  const auto image = [](std::uint64_t seed, double block) {
    Rendering shared = shared_passes(24, 0.1 * std::sqrt(32), seed);
    MeanError error = stored_mean_error(shared).value();
    Generator g(seed + 100'000);
    std::normal_distribution<double> noise(0, 0.02);
    double squares = 0;
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        const double own = picture(x, y) * noise(g), factor = x < 8 && y >= 16 ? block : 1;
        squares += std::pow(0.02 * picture(x, y) / 576, 2);
        for (int c = 0; c < 3; ++c) {
          float& mean = shared.mean.pixel(x, y)[c];
          mean = static_cast<float>((double{mean} + own) * factor);
          shared.variance->pixel(x, y)[c] += static_cast<float>(std::pow(0.02 * picture(x, y), 2));
        }
      }
    for (double& channel : error.standard_error) channel = std::sqrt(channel * channel + squares);
    store_mean_error(shared, error);
    return shared;
  };
  int alarms = 0, without = 0, found = 0;
  constexpr int pairs = 200;
  for (std::uint64_t pair = 0; pair < pairs; ++pair) {
    const Rendering reference = image(2 * pair + 1, 1), test = image(2 * pair + 2, 1);
    alarms += test_agreement(reference, test).blocks.pass ? 0 : 1;
    found += test_agreement(reference, image(2 * pair + 2, 1.25)).blocks.pass ? 0 : 1;
    Rendering silent = test, silent_reference = reference;
    silent.metadata.clear();
    silent_reference.metadata.clear();
    without += test_agreement(silent_reference, silent).blocks.pass ? 0 : 1;
  }
  std::printf("%d false alarms, %d without its word, %d found, of %d\n", alarms, without, found, pairs);
  EXPECT_LT(alarms, 4);
  EXPECT_GT(without, pairs / 2);
  EXPECT_GE(found, 193);
}

TEST(agreement, looks_beside_a_light_without_noise) {
  // One of 36 blocks is exact and 2000 times as bright as the others. It counts as four of the others' 35, so that an
  // error by s in them is one of 0.897 s in the mean. Weighed by certainty alone, or in the plain mean, the light would
  // be all. A power of 0.99 at s = 1.15 would_see finds 193 of 200 with probability 0.995.
  const auto light = [](int x, int y) { return x < 8 && y < 8; };
  const auto image = [&](double factor, std::uint64_t seed) {
    Rendering with = render(
        48, 16, [&](int x, int y) { return light(x, y) ? 0.0 : factor; }, gaussian, seed);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) std::fill_n(with.mean.pixel(x, y), 3, 2000.0f);
    return with;
  };
  constexpr int pairs = 200;
  int found = 0;
  double said = 0;
  for (std::uint64_t pair = 0; pair < pairs; ++pair) {
    const Rendering reference = image(1, 2 * pair + 1);
    const double size = test_agreement(reference, image(1, 2 * pair + 2)).would_see.value();
    said += size / pairs;
    found += test_agreement(reference, image(1 + 1.15 * size, 2 * pair + 2)).whole.pass ? 0 : 1;
  }
  std::printf("+-%.2g %% of the mean found beside a light in %d of %d\n", 100 * said, found, pairs);
  EXPECT_GE(found, 193);
}

TEST(agreement, finds_two_percent_of_energy) {
  // 64 samples of deviation 0.5 leave 6 % a pixel, and sqrt(2) 6 % / 8 = 1.1 % a block of a difference. The error of 2
  // % on each of 64 blocks is 1.8 deviations, chi^2 64 (1 + 3.3) against the bound 94. No single pixel can show it.
  const auto darker = [](int x, int y) { return 0.98 * picture(x, y); };
  for (std::uint64_t seed = 1; seed < 20; seed += 2) {
    const Agreement result =
        test_agreement(render(64, 64, picture, gaussian, seed), render(64, 64, darker, gaussian, seed + 1));
    EXPECT_FALSE(result.blocks.pass) << result.blocks.sentence;
    EXPECT_FALSE(result.pass());
  }
}

TEST(agreement, judges_blocks_at_their_level) {
  // 16 blocks: chi^2 with 16 degrees of freedom exceeds 38.922 with probability 1 - 0.99^(1/9) = 0.00111608, from
  // exp(-x/2) sum over k < 8 of (x/2)^k/k!.
  const Rendering image = render(32, 4, picture, gaussian, 1);
  const Agreement result = test_agreement(image, image);
  EXPECT_EQ(result.blocks.n, 16u);
  EXPECT_NEAR(result.blocks.alpha, 0.00111608, 1e-8);
  EXPECT_NEAR(result.blocks.bound, 38.9222, 1e-4);
  EXPECT_EQ(result.whole.alpha, result.blocks.alpha);
  EXPECT_NEAR(result.whole.bound, 3.2595, 1e-4);
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
  // Three tests of, here, 1728 values: 1 - 0.99^(1/5184) = 1.9387e-6, whose two-sided normal quantile is 4.7597.
  EXPECT_NEAR(result.pixels.alpha, 1.9387e-6, 1e-10);
  EXPECT_NEAR(result.pixels.bound, 4.7597, 1e-4);
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
  EXPECT_FALSE(test_agreement(black, black).would_see);
}

TEST(agreement, needs_variances) {
  Rendering with = render(8, 2, picture, gaussian, 1), without = with;
  without.variance.reset();
  EXPECT_THROW(test_agreement(with, without), InputError);
  EXPECT_THROW(test_agreement(without, with), InputError);
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
