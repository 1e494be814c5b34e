// Right images that the gates' statistics call wrong, by kind of noise and number of images: no more of them than alpha
// and three standard deviations. Each kind is made of known parts, its expectation is the reference.
//
//   PHOTONPROOF_NULL_RUNS=1000 build/release/bin/null_table_test --gtest_filter=null_table.*
//
// prints the table of reports/published/null.md; ctest makes it of a few runs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>

#include "harness/statistics/gate_statistics.h"

namespace photonproof {
namespace {

using Random = std::mt19937_64;
constexpr int side = 32, samples = 16;
constexpr double alpha = 0.05;

double truth(int x, int y, int c) { return 0.2 + 0.05 * c + 0.02 * x + (y > 12 ? 0.5 : 0.0); }

/// A value over its expectation, by pixel; drawn anew for each image, so that a kind can keep what the image shares.
using Factor = std::function<double(Random&, int x, int y)>;
struct Kind {
  const char* name;
  std::function<Factor(Random&)> image;
};

double normal(Random& random, double mean, double deviation) {
  return std::normal_distribution<double>(mean, deviation)(random);
}

Kind by_pixel(const char* name, const Factor& factor) {
  return {name, [factor](Random&) { return factor; }};
}

/// 16 samples a pixel, of which one in `one_in` brings `share` of the light, the others the rest with 10 % of noise.
Kind rare(const char* name, double share, double one_in) {
  return by_pixel(name, [=](Random& random, int, int) {
    const int met = std::poisson_distribution<int>(samples / one_in)(random);
    return (1 - share) * normal(random, 1, 0.1) + share * met * one_in / samples;
  });
}

/// 10 % of noise a pixel, and `deviation` that the pixels of a square share, or of the image.
Kind shared(const char* name, int square, double deviation) {
  return {name, [=](Random& random) -> Factor {
            std::vector<double> parts(static_cast<std::size_t>(side * side));
            for (double& part : parts) part = normal(random, 0, deviation);
            return [=](Random& pixel, int x, int y) {
              return normal(pixel, 1, 0.1) + parts[static_cast<std::size_t>(y / square * side + x / square)];
            };
          }};
}

double mean_of_log_normals(Random& random) {
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += std::exp(normal(random, -0.5, 1));
  return sum / samples;
}

std::vector<Kind> kinds() {
  return {
      by_pixel("Gaussian, 10 % a pixel", [](Random& random, int, int) { return normal(random, 1, 0.1); }),
      by_pixel("Gaussian, a hundredfold variance beside a simple one",
               [](Random& random, int x, int) { return normal(random, 1, x % 3 == 0 ? 0.2 : 0.02); }),
      by_pixel("skewed: exponential, one sample",
               [](Random& random, int, int) { return std::exponential_distribution<double>()(random); }),
      by_pixel("skewed: log-normal, 16 samples", [](Random& random, int, int) { return mean_of_log_normals(random); }),
      rare("rare: 5 % of the light in 1/2,000 of the samples", 0.05, 2000),
      rare("rare: 5 % of the light in 1/20,000 of the samples", 0.05, 20000),
      rare("rare: half of the light in 1/100 of the samples", 0.5, 100),
      shared("shared within blocks, 5 %", 8, 0.05),
      shared("shared within blocks, 20 %", 8, 0.2),
      shared("shared within squares of 3 pixels, 10 %", 3, 0.1),
      shared("shared within squares of 11 pixels, 10 %", 11, 0.1),
      shared("shared by either half, 3 %", side / 2, 0.03),
      shared("shared over the image, 1 %", side, 0.01),
      shared("shared over the image, 5 %", side, 0.05),
  };
}

Image drawn(Random& random, const Kind& kind) {
  Image image(side, side);
  const Factor factor = kind.image(random);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<float>(truth(x, y, c) * factor(random, x, y));
  return image;
}

Rendering known_reference() {
  Rendering reference{Image(side, side), Image(side, side), {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c) {
        reference.mean.pixel(x, y)[c] = static_cast<float>(truth(x, y, c));
        reference.variance->pixel(x, y)[c] = static_cast<float>(std::pow(1e-4 * truth(x, y, c), 2));
      }
  return reference;
}

struct Count {
  int runs = 0, failed = 0, passed = 0;
  int most() const { return static_cast<int>(runs * alpha + 3 * std::sqrt(runs * alpha * (1 - alpha))); }
};

Count judged(const Kind& kind, int images, int looks, int runs) {
  Random random(7);
  const Rendering reference = known_reference();
  Count count;
  for (; count.runs < runs; ++count.runs) {
    std::vector<Image> all;
    std::optional<GateVerdict> verdict;
    for (int look = 0; look < looks && !verdict; ++look) {
      while (all.size() < static_cast<std::size_t>(images) << look) all.push_back(drawn(random, kind));
      std::vector<const Image*> pointers;
      for (const Image& image : all) pointers.push_back(&image);
      verdict = judge_agreement(measure_deviations(reference, pointers, {999}), {0.02, 0.2}, alpha / looks).verdict;
    }
    count.failed += verdict == GateVerdict::fail ? 1 : 0;
    count.passed += verdict == GateVerdict::pass ? 1 : 0;
  }
  return count;
}

int asked_runs(int usual) {
  const char* asked = std::getenv("PHOTONPROOF_NULL_RUNS");
  return asked != nullptr ? std::atoi(asked) : usual;
}

TEST(null_table, right_images_fail_no_more_often_than_alpha_whatever_their_noise) {
  const int runs = asked_runs(12);
  std::printf("| noise | 3 images | 4 | 5 | 6 | 7 | 8 | 4, then 8 |\n|---|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Kind& kind : kinds()) {
    std::string row = std::string("| ") + kind.name + " |";
    for (const auto& [images, looks] : {std::pair{3, 1}, {4, 1}, {5, 1}, {6, 1}, {7, 1}, {8, 1}, {4, 2}}) {
      const Count count = judged(kind, images, looks, runs);
      row += " " + std::to_string(count.failed) + " / " + std::to_string(count.passed) + " |";
      EXPECT_LE(count.failed, count.most()) << kind.name << ", " << images << " images, " << looks << " looks";
    }
    std::printf("%s\n", row.c_str());
  }
}

// Statistics that call nothing wrong have no false alarms either: 8 images that are off by 5 % everywhere, or by 30 %
// in one block, of noise that allows that to be seen.
TEST(null_table, an_error_is_found_beside_each_kind_of_noise_that_allows_it) {
  const Rendering reference = known_reference();
  Random random(9);
  for (const Kind& kind : {kinds()[0], kinds()[1], kinds()[3], kinds()[12]})
    for (const bool in_block : {false, true}) {
      int found = 0;
      constexpr int runs = 10;
      for (int run = 0; run < runs; ++run) {
        std::vector<Image> images;
        for (int i = 0; i < 8; ++i) {
          images.push_back(drawn(random, kind));
          for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
              for (int c = 0; c < 3; ++c)
                images.back().pixel(x, y)[c] *= !in_block ? 0.95f : x / 8 == 1 && y / 8 == 2 ? 0.7f : 1.0f;
        }
        std::vector<const Image*> pointers;
        for (const Image& image : images) pointers.push_back(&image);
        const Judgement judgement = judge_agreement(measure_deviations(reference, pointers, {999}), {0.02, 0.2}, 0.001);
        found += judgement.verdict == GateVerdict::fail ? 1 : 0;
      }
      EXPECT_GE(found, 9) << kind.name << (in_block ? ", a block" : ", everywhere");
    }
}

// A twentieth of the light comes in one sample of 20,000, of which four images of 1,024 pixels meet three: some meet
// none. They are 5 % too dark, more than their noise explains, and nothing is known.
TEST(null_table, rare_samples_that_may_be_missing_leave_it_undecided_and_are_named) {
  const Rendering reference = known_reference();
  const Kind kind = rare("", 0.05, 20000);
  Random random(5);
  int named = 0;
  for (int run = 0; run < 20; ++run) {
    std::vector<Image> images;
    for (int i = 0; i < 4; ++i) images.push_back(drawn(random, kind));
    std::vector<const Image*> pointers;
    for (const Image& image : images) pointers.push_back(&image);
    const Judgement judgement = judge_agreement(measure_deviations(reference, pointers, {999}), {0.02, 0.2}, 0.001);
    EXPECT_NE(judgement.verdict, GateVerdict::pass);
    if (!judgement.verdict && judgement.sentence.starts_with("too few samples to meet rare bright ones: ")) ++named;
  }
  EXPECT_GE(named, 15);
}

}  // namespace
}  // namespace photonproof
