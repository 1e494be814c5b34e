// Tests verify's false alarms: pairs of right pictures that it calls different, by kind of noise. There may be no more
// of them than alpha and three standard deviations. Sides are pictures with a variance layer of 64 samples, sets of
// eight pictures without one, and a well-known reference.
//
// PHOTONPROOF_NULL_RUNS=1000 build/release/bin/verify_unit_test --gtest_filter=verify_null.*
//
// prints the table of reports/published/null.md; ctest makes a smaller one.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "harness/statistics/pooled_pictures.h"
#include "harness/statistics/test_noise_kinds.h"
#include "harness/verify/engine_renderer.h"
#include "harness/verify/picture_pair.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_verify {
namespace {

using namespace noise_kinds;

constexpr double alpha = 0.05;
constexpr int samples_a_pixel = 64, pictures = 8;

EnginePicture reference_picture() {
  EnginePicture picture;
  picture.rendering = known_reference();
  return picture;
}

EnginePicture without_layer(Random& random, const Kind& kind) {
  std::vector<PictureOfSamples> parts;
  for (int i = 0; i < pictures; ++i) parts.push_back({{drawn(random, kind), {}, {}}, samples_a_pixel});
  return pooled_picture(parts);
}

/// Samples over their expectation. `gain` is the common factor of a pass of one sample a pixel, for the kinds that have
/// one.
struct SampleKind {
  const char* name;
  std::function<double(Random&)> sample;
  double gain = 0;
  bool photons = false;  ///< squares of 8 pixels share `gain`, not the image; the mean has no known error
};

std::vector<SampleKind> sample_kinds() {
  const auto rare_light = [](double share, double one_in) {
    return [=](Random& random) {
      const bool met = std::bernoulli_distribution(1 / one_in)(random);
      return (1 - share) * normal(random, 1, 0.4) + (met ? share * one_in : 0);
    };
  };
  const auto gaussian = [](Random& random) { return normal(random, 1, 0.4); };
  return {
      {"Gaussian, 40 % a sample", gaussian},
      {"skewed: exponential samples", [](Random& random) { return std::exponential_distribution<double>()(random); }},
      {"skewed: log-normal samples", [](Random& random) { return std::exp(normal(random, -0.5, 1)); }},
      {"rare: 5 % of the light in 1/2,000 of the samples", rare_light(0.05, 2000)},
      {"rare: 5 % of the light in 1/20,000 of the samples", rare_light(0.05, 20000)},
      {"rare: half of the light in 1/100 of the samples", rare_light(0.5, 100)},
      {"shared over the image, 2 %, as it says", gaussian, 0.16},
      {"photons that 8 x 8 pixels share, 10 %", gaussian, 0.8, true},
  };
}

struct PassSums {
  double sum[3]{}, squares[3]{};
};

/// One engine's picture with its variance layer, from passes of one sample a pixel.
EnginePicture with_layer(Random& random, const SampleKind& kind) {
  constexpr double n = samples_a_pixel;
  EnginePicture picture;
  picture.rendering = {Image(side, side), Image(side, side), {}};
  std::vector<double> sums(picture.rendering.mean.rgb.size()), squares(sums.size()), gains(side * side, 1);
  PassSums passes;
  for (int pass = 0; pass < samples_a_pixel; ++pass) {
    const double common = kind.gain > 0 && !kind.photons ? normal(random, 1, kind.gain) : 1;
    if (kind.photons)
      for (double& gain : gains) gain = normal(random, 1, kind.gain);
    double mean[3]{};
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const int x = static_cast<int>(i / 3) % side, y = static_cast<int>(i / 3) / side;
      const double gain = common * gains[static_cast<std::size_t>(y / 8 * side + x / 8)];
      const double value = truth(x, y, static_cast<int>(i % 3)) * kind.sample(random) * gain;
      sums[i] += value;
      squares[i] += value * value;
      mean[i % 3] += value / (side * side);
    }
    for (int c = 0; c < 3; ++c) {
      passes.sum[c] += mean[c];
      passes.squares[c] += mean[c] * mean[c];
    }
  }
  const auto variance = [&](double sum, double square) { return (square / n - sum * sum / n / n) / (n - 1); };
  for (std::size_t i = 0; i < sums.size(); ++i) {
    picture.rendering.mean.rgb[i] = static_cast<float>(sums[i] / n);
    picture.rendering.variance->rgb[i] = static_cast<float>(variance(sums[i], squares[i]));
  }
  if (kind.gain > 0 && !kind.photons) {
    MeanError error{{}, n};
    for (std::size_t c = 0; c < 3; ++c) error.standard_error[c] = std::sqrt(variance(passes.sum[c], passes.squares[c]));
    store_mean_error(picture.rendering, error);
  }
  if (kind.photons) store_shared_photons(picture.rendering);
  return picture;
}

using Drawn = std::function<EnginePicture(Random&)>;

struct Count {
  int runs = 0, differ = 0;
  int most() const { return static_cast<int>(runs * alpha + 3 * std::sqrt(runs * alpha * (1 - alpha))); }
};

Count judged(const Drawn& first, const Drawn& second, int runs) {
  Random random(11);
  Count count;
  for (; count.runs < runs; ++count.runs)
    count.differ += test_pair(first(random), second(random), alpha).differs ? 1 : 0;
  return count;
}

void expect_level(const std::string& name, const Drawn& drawn, int runs) {
  const Drawn known = [](Random&) { return reference_picture(); };
  std::string row = "| " + name + " |";
  for (const auto& [first, second] : {std::pair{drawn, drawn}, {known, drawn}}) {
    const Count count = judged(first, second, runs);
    row += " " + std::to_string(count.differ) + " |";
    EXPECT_LE(count.differ, count.most()) << name;
  }
  std::printf("%s\n", row.c_str());
}

TEST(verify_null, right_pictures_differ_no_more_often_than_alpha_whatever_their_noise) {
  const int runs = asked_runs(12);
  std::printf("| noise | with one of its kind | with a reference |\n|---|--:|--:|\n");
  for (const SampleKind& kind : sample_kinds())
    expect_level(
        std::string("a layer of 64 samples; ") + kind.name, [&](Random& random) { return with_layer(random, kind); },
        runs);
  for (const Kind& kind : kinds())
    expect_level(
        std::string("8 pictures; ") + kind.name, [&](Random& random) { return without_layer(random, kind); }, runs);
}

// A test that never finds a difference has no false alarms either, so errors are planted. One of two pictures is off by
// 5 % everywhere, or by 30 % in one block.
TEST(verify_null, an_error_is_found_beside_noise_that_allows_it) {
  const auto off = [](EnginePicture picture, bool in_block) {
    std::vector<Image*> images{&picture.rendering.mean};
    for (Image& image : picture.images) images.push_back(&image);
    for (Image* image : images)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          for (int c = 0; c < 3; ++c)
            image->pixel(x, y)[c] *= !in_block ? 0.95f : x / 8 == 1 && y / 8 == 2 ? 0.7f : 1.0f;
    return picture;
  };
  const Drawn drawn[] = {[](Random& random) { return with_layer(random, sample_kinds()[0]); },
                         [](Random& random) { return with_layer(random, sample_kinds()[1]); },
                         [](Random& random) { return without_layer(random, kinds()[0]); },
                         [](Random& random) { return without_layer(random, kinds()[12]); }};
  Random random(9);
  for (std::size_t kind = 0; kind < std::size(drawn); ++kind)
    for (const bool in_block : {false, true}) {
      int found = 0;
      for (int run = 0; run < 10; ++run)
        found += test_pair(drawn[kind](random), off(drawn[kind](random), in_block)).differs ? 1 : 0;
      EXPECT_GE(found, 9) << kind << (in_block ? ", a block" : ", everywhere");
    }
}

}  // namespace
}  // namespace photonproof::inline harness_verify
