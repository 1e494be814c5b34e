// False alarms and power of the gates' statistics, on noise whose truth is known.
#include "harness/statistics/gate_statistics.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "harness/statistics/student.h"

namespace photonproof::inline harness_statistics {
namespace {

using Random = std::mt19937_64;
/// The value of one image's pixel; its expectation is expected(x, y, c).
using Noise = std::function<float(Random&, int x, int y, int c)>;

double expected(int x, int y, int c) { return 0.2 + 0.05 * c + 0.02 * x + (y > 7 ? 0.5 : 0.0); }

struct Setting {
  const char* name;
  Noise noise;
};

/// Draws 65,536 values beforehand; noise takes one at random. Slow distributions are sampled only once, and images and
/// references still share one distribution.
std::vector<double> drawn_ahead(const std::function<double(Random&)>& distribution) {
  Random random(3);
  std::vector<double> draws(1 << 16);
  for (double& draw : draws) draw = distribution(random);
  return draws;
}
double one_of(const std::vector<double>& draws, Random& random) { return draws[random() >> 48]; }

const std::vector<double>& gammas() {
  static const auto draws =
      drawn_ahead([](Random& random) { return std::gamma_distribution<double>(16, 1.0 / 16)(random); });
  return draws;
}

// Mean of 16 samples of each kind, as a renderer with 16 samples a pixel would make them.
std::vector<Setting> settings() {
  const auto normals = drawn_ahead([](Random& random) { return std::normal_distribution<double>()(random); });
  const auto log_normals = drawn_ahead([](Random& random) {
    double sum = 0;
    for (int i = 0; i < 16; ++i) sum += std::exp(std::normal_distribution<double>(-0.5, 1)(random));
    return sum / 16;
  });
  return {
      {"normal noise, a hundredfold variance beside a simple one",
       [normals](Random& random, int x, int y, int c) {
         const double deviation = (x / 3) % 2 == 0 ? 0.02 : 0.2;
         return static_cast<float>(expected(x, y, c) * (1 + deviation * one_of(normals, random)));
       }},
      {"mean of 16 exponential samples",
       [](Random& random, int x, int y, int c) {
         return static_cast<float>(expected(x, y, c) * one_of(gammas(), random));
       }},
      {"one sample in ten is bright, the others are black",
       [](Random& random, int x, int y, int c) {
         return static_cast<float>(expected(x, y, c) * 10 * std::binomial_distribution<int>(16, 0.1)(random) / 16);
       }},
      {"log-normal, sigma 1",
       [log_normals](Random& random, int x, int y, int c) {
         return static_cast<float>(expected(x, y, c) * one_of(log_normals, random));
       }},
      {"a few pixels see a light that the others do not, one time in twenty",
       [](Random& random, int x, int y, int c) {
         const double base = expected(x, y, c) * one_of(gammas(), random);
         if ((x + 5 * y) % 7 != 0) return static_cast<float>(base);
         return static_cast<float>(base / 2 +
                                   expected(x, y, c) / 2 * 20 * std::binomial_distribution<int>(16, 0.05)(random) / 16);
       }},
  };
}

constexpr int width = 24, height = 16;

Image draw(Random& random, const Noise& noise) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = noise(random, x, y, c);
  return image;
}

/// Builds a reference as the program does: the mean of many images, with the variance of that mean.
Rendering reference_of(Random& random, const Noise& noise, int images) {
  std::vector<Image> drawn;
  std::vector<const Image*> pointers;
  for (int i = 0; i < images; ++i) drawn.push_back(draw(random, noise));
  for (const Image& image : drawn) pointers.push_back(&image);
  Rendering reference{mean_of(pointers), Image(width, height), {}};
  for (std::size_t i = 0; i < reference.mean.rgb.size(); ++i) {
    double squares = 0;
    for (const Image& image : drawn) squares += std::pow(double{image.rgb[i]} - double{reference.mean.rgb[i]}, 2);
    reference.variance->rgb[i] = static_cast<float>(squares / (images - 1.0) / images);
  }
  return reference;
}

/// The 95 % quantile of the false alarms in `runs` at a rate of alpha.
double most_alarms(int runs, double alpha) { return boost::math::quantile(boost::math::binomial(runs, alpha), 0.95); }

/// The verdict of a gate that looks at 8, 16 ... images; empty if no look decides.
std::optional<GateVerdict> sequential(Random& random, const Noise& noise, int looks,
                                      const std::function<Judgement(std::span<const Image* const>)>& judge) {
  std::vector<Image> drawn;
  for (int look = 0; look < looks; ++look) {
    while (drawn.size() < std::size_t{8} << look) drawn.push_back(draw(random, noise));
    std::vector<const Image*> images;
    for (const Image& image : drawn) images.push_back(&image);
    if (const auto verdict = judge(images).verdict) return verdict;
  }
  return std::nullopt;
}

TEST(gate_statistics, agreement_holds_its_false_alarm_rate_over_all_looks) {
  constexpr int runs = 1000, looks = 2;
  constexpr double alpha = 0.05;
  // Bounds of 1e-9 are never reached, so that every run takes all its looks. The variance of the reference's 2000
  // images is at most 1/125 of that of a run's images.
  for (const Setting& setting : settings()) {
    Random random(7);
    const Rendering reference = reference_of(random, setting.noise, 2000);
    Image least = *reference.variance;
    for (float& value : least.rgb) value *= 2000;
    int alarms = 0;
    for (int run = 0; run < runs; ++run) {
      const auto verdict = sequential(random, setting.noise, looks, [&](auto images) {
        return judge_agreement(measure_deviations(reference, images, {1999, &least}), {1e-9, 1e-9}, alpha / looks);
      });
      if (verdict == GateVerdict::fail) ++alarms;
    }
    std::printf("%s: %d false alarms in %d, alpha %g\n", setting.name, alarms, runs, alpha);
    EXPECT_LE(alarms, most_alarms(runs, alpha)) << setting.name;
  }
}

Noise gamma_noise(double whole_factor, double block_factor) {
  return [=](Random& random, int x, int y, int c) {
    const double factor = whole_factor * (x >= 8 && x < 16 && y >= 8 ? block_factor : 1);
    return static_cast<float>(factor * expected(x, y, c) * one_of(gammas(), random));
  };
}

TEST(gate_statistics, agreement_rarely_passes_over_an_error_as_large_as_its_bounds) {
  // The promise: a deviation of `bound` passes with probability 0.01 a look at most, here 0.02 over two looks.
  constexpr int runs = 400, looks = 2;
  Random random(11);
  const Rendering reference = reference_of(random, gamma_noise(1, 1), 1000);
  for (const auto& [whole, block] : {std::pair{1.03, 1.0}, std::pair{1.0, 1.2}}) {
    int passed = 0;
    for (int run = 0; run < runs; ++run) {
      const auto verdict = sequential(random, gamma_noise(whole, block), looks, [&](auto images) {
        return judge_agreement(measure_deviations(reference, images, {999}), {0.03, 0.2}, 0.001 / looks);
      });
      if (verdict == GateVerdict::pass) ++passed;
    }
    EXPECT_LE(passed, most_alarms(runs, 0.02)) << whole << " " << block;
  }
}

TEST(gate_statistics, agreement_passes_a_right_image_once_its_bounds_are_within_reach) {
  // A value's relative deviation is 1/4 (16 exponential samples). So 16 images of 384 pixels leave 0.25/sqrt(16 384) =
  // 0.32 % overall and 0.25/sqrt(16 64) = 0.78 % a block. The minimum detectable error at probability 0.99 is (5.8 +
  // 2.6) 0.32 % = 2.7 % overall, with Student's quantiles for 15 degrees of freedom. A block's is 7 0.78 % = 5.5 %.
  Random random(3);
  const Rendering reference = reference_of(random, gamma_noise(1, 1), 1000);
  int passed = 0;
  for (int run = 0; run < 50; ++run)
    if (sequential(random, gamma_noise(1, 1), 2, [&](auto images) {
          return judge_agreement(measure_deviations(reference, images, {999}), {0.05, 0.2}, 0.0005);
        }) == GateVerdict::pass)
      ++passed;
  EXPECT_GE(passed, 49);
}

TEST(gate_statistics, agreement_asks_for_more_images_while_its_bounds_are_out_of_reach) {
  Random random(3);
  const Noise noise = gamma_noise(1, 1);
  const Rendering reference = reference_of(random, noise, 500);
  std::vector<Image> drawn(8);
  std::vector<const Image*> images;
  for (Image& image : drawn) {
    image = draw(random, noise);
    images.push_back(&image);
  }
  const Judgement judgement = judge_agreement(measure_deviations(reference, images, {499}), {0.0001, 0.001}, 0.001);
  EXPECT_FALSE(judgement.verdict);
  EXPECT_EQ(judgement.sentence.rfind("too noisy to tell: ", 0), 0u) << judgement.sentence;
  EXPECT_NE(judgement.sentence.find("could hide in the block at ("), std::string::npos) << judgement.sentence;
}

TEST(gate_statistics, a_failing_place_is_named_with_its_size_and_channel) {
  Random random(5);
  const Rendering reference = reference_of(random, gamma_noise(1, 1), 500);
  std::vector<Image> drawn(8);
  std::vector<const Image*> images;
  for (Image& image : drawn) {
    image = draw(random, gamma_noise(1, 1));
    // 3 x 4 pixels lose half their red.
    for (int y = 9; y < 13; ++y)
      for (int x = 10; x < 13; ++x) image.pixel(x, y)[0] *= 0.2f;
    images.push_back(&image);
  }
  const Judgement judgement = judge_agreement(measure_deviations(reference, images, {499}), {0.03, 0.2}, 0.001);
  ASSERT_EQ(judgement.verdict, GateVerdict::fail);
  ASSERT_EQ(judgement.tiles.size(), 1u);
  const FailingTile& tile = judgement.tiles.front();
  EXPECT_EQ(tile.x, 10);
  EXPECT_EQ(tile.y, 9);
  EXPECT_EQ(tile.width, 3);
  EXPECT_EQ(tile.height, 4);
  EXPECT_EQ(judgement.sentence, tile.sentence);
  EXPECT_EQ(tile.sentence.substr(tile.sentence.find('%')), "% over 12 px at (10, 9), red only");
}

/// Every value `factor` times the reference of 1, with normal noise of one part in a hundred.
Judgement bias_judgement(double factor, bool block, double bound) {
  Random random(9);
  Rendering reference{Image(width, height), Image(width, height), {}};
  std::fill(reference.mean.rgb.begin(), reference.mean.rgb.end(), 1.0f);
  std::vector<Image> drawn(8, Image(width, height));
  std::vector<const Image*> images;
  for (Image& image : drawn) {
    for (float& value : image.rgb)
      value = static_cast<float>(factor * (1 + 0.01 * std::normal_distribution<double>()(random)));
    images.push_back(&image);
  }
  return judge_bias(measure_deviations(reference, images, {1e9}), block, bound, 0.001);
}

TEST(gate_statistics, bias_passes_within_fails_outside_and_else_asks_for_more) {
  for (const bool block : {false, true}) {
    EXPECT_EQ(bias_judgement(1.02, block, 0.1).verdict, GateVerdict::pass);
    EXPECT_EQ(bias_judgement(1.2, block, 0.1).verdict, GateVerdict::fail);
    EXPECT_EQ(bias_judgement(0.8, block, 0.1).verdict, GateVerdict::fail);
    EXPECT_FALSE(bias_judgement(1.1, block, 0.1).verdict);
  }
  EXPECT_EQ(bias_judgement(1.2, true, 0.1).sentence, "+20 % over 384 px at (0, 0); bound 10 %");
}

TEST(gate_statistics, bias_at_its_bound_fails_no_more_often_than_alpha) {
  // The truth lies on the bound: failing and passing are equally wrong there, and each is as rare as alpha.
  constexpr int runs = 2000;
  constexpr double alpha = 0.05;
  Rendering reference{Image(width, height), Image(width, height), {}};
  std::fill(reference.mean.rgb.begin(), reference.mean.rgb.end(), 1.0f);
  Random random(21);
  int failed = 0, passed = 0;
  for (int run = 0; run < runs; ++run) {
    std::vector<Image> drawn(8, Image(width, height));
    std::vector<const Image*> images;
    for (Image& image : drawn) {
      for (float& value : image.rgb)
        value = static_cast<float>(1.1 * std::gamma_distribution<double>(16, 1.0 / 16)(random));
      images.push_back(&image);
    }
    const auto verdict = judge_bias(measure_deviations(reference, images, {1e9}), true, 0.1, alpha).verdict;
    if (verdict == GateVerdict::fail) ++failed;
    if (verdict == GateVerdict::pass) ++passed;
  }
  EXPECT_LE(failed, most_alarms(runs, alpha));
  EXPECT_LE(passed, most_alarms(runs, alpha));
}

TEST(gate_statistics, a_metric_passes_within_fails_outside_and_else_asks_for_more) {
  const std::vector<double> near_a_half{0.50, 0.51, 0.49, 0.50, 0.52, 0.48, 0.50, 0.50};
  const auto verdict = [&](BoundKind kind, double bound) {
    return judge_metric("m", near_a_half, kind, bound, 0.001).verdict;
  };
  EXPECT_EQ(verdict(BoundKind::minimum, 0.4), GateVerdict::pass);
  EXPECT_EQ(verdict(BoundKind::minimum, 0.6), GateVerdict::fail);
  EXPECT_FALSE(verdict(BoundKind::minimum, 0.5));
  EXPECT_EQ(verdict(BoundKind::maximum, 0.6), GateVerdict::pass);
  EXPECT_EQ(verdict(BoundKind::maximum, 0.4), GateVerdict::fail);
  EXPECT_FALSE(verdict(BoundKind::maximum, 0.5));
  EXPECT_EQ(verdict(BoundKind::absolute_maximum, 0.6), GateVerdict::pass);
  EXPECT_EQ(verdict(BoundKind::absolute_maximum, 0.4), GateVerdict::fail);
}

TEST(gate_statistics, metrics_hold_their_false_alarm_rate_on_skewed_values) {
  // Values like relmse of images with rare bright pixels: log-normal, sigma 0.5; the mean exp(0.125) is the bound.
  constexpr int runs = 2000;
  constexpr double alpha = 0.05;
  Random random(4);
  int failed = 0;
  for (int run = 0; run < runs; ++run) {
    std::vector<double> values;
    for (int i = 0; i < 8; ++i) values.push_back(std::exp(0.5 * std::normal_distribution<double>()(random)));
    if (judge_metric("relmse", values, BoundKind::maximum, std::exp(0.125), alpha).verdict == GateVerdict::fail)
      ++failed;
  }
  EXPECT_LE(failed, most_alarms(runs, alpha));
}

TEST(gate_statistics, a_reference_in_half_floats_alarms_no_image_without_noise) {
  // The truth is a little above a half float: one pixel in a hundred of the reference is rounded up, by 2^-10. Its
  // stated variance is the rounding's, (x - a)(b - x), a hundredth of the square of its deviation.
  Random random(17);
  const double a = 1, b = 1 + std::ldexp(1.0, -10), x = a + 0.01 * (b - a);
  Image exact(width, height);
  std::fill(exact.rgb.begin(), exact.rgb.end(), static_cast<float>(x));
  const std::vector<const Image*> images(8, &exact);
  for (int run = 0; run < 200; ++run) {
    Rendering reference{Image(width, height), Image(width, height), {}};
    for (float& value : reference.mean.rgb)
      value = static_cast<float>(std::uniform_real_distribution<double>()(random) < 0.01 ? b : a);
    std::fill(reference.variance->rgb.begin(), reference.variance->rgb.end(), static_cast<float>((x - a) * (b - x)));
    EXPECT_NE(judge_agreement(measure_deviations(reference, images, {31}), {0.01, 0.05}, 0.05).verdict,
              GateVerdict::fail);
  }
}

TEST(gate_statistics, expectations_are_worth_what_the_spread_of_variances_shows) {
  // The variances have 7 degrees of freedom: s^2 = truth chi^2_7 / 7. Their truths scatter as 10 degrees of freedom
  // around 1 do: truth = 10 / chi^2_10 (Smyth 2004). Variances around one truth give a very large freedom.
  Random random(13);
  std::vector<double> scattered, alike;
  for (int i = 0; i < 20000; ++i) {
    const double estimate = std::chi_squared_distribution<double>(7)(random) / 7;
    alike.push_back(estimate);
    scattered.push_back(estimate * 10 / std::chi_squared_distribution<double>(10)(random));
  }
  EXPECT_NEAR(freedom_of_expectation(scattered, 7), 10, 1);
  EXPECT_GT(freedom_of_expectation(alike, 7), 200);
}

// Eight images are 5 % too bright: an allowed error of 6 % explains them, one of 3 % does not. The promised minimum
// detectable error adds to the allowed one.
TEST(gate_statistics, agreement_is_of_what_is_beyond_the_errors_that_are_allowed) {
  Random random(21);
  Rendering reference{Image(width, height), Image(width, height), {}};
  for (float& value : reference.mean.rgb) value = 1;
  for (float& value : reference.variance->rgb) value = 1e-8f;
  std::vector<Image> drawn(8, Image(width, height));
  std::vector<const Image*> images;
  for (Image& image : drawn) {
    for (float& value : image.rgb) value = static_cast<float>(std::normal_distribution<double>(1.05, 0.01)(random));
    images.push_back(&image);
  }
  const Deviations deviations = measure_deviations(reference, images, {31});
  const Judgement inside = judge_agreement(deviations, {0.1, 0.2}, 0.001, {0.06, 0.1});
  EXPECT_EQ(inside.verdict, GateVerdict::pass) << inside.sentence;
  EXPECT_GT(inside.would_see.value_or(0), 0.06);
  const Judgement outside = judge_agreement(deviations, {0.1, 0.2}, 0.001, {0.03, 0.1});
  EXPECT_EQ(outside.verdict, GateVerdict::fail);
  EXPECT_EQ(outside.whole_off, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(outside.blocks_off, (std::array<bool, 3>{}));
  EXPECT_EQ(judge_agreement(deviations, {0.1, 0.2}, 0.001, {0.06, 0.01}).blocks_off[1], true);
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
