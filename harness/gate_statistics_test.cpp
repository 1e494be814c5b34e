// False alarms and power of the gates' statistics, on noise whose truth is known.
#include "harness/gate_statistics.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "harness/student.h"

namespace photonproof {
namespace {

using Random = std::mt19937_64;
/// The value of one image's pixel; its expectation is expected(x, y, c).
using Noise = std::function<float(Random&, int x, int y, int c)>;

double expected(int x, int y, int c) { return 0.2 + 0.05 * c + 0.02 * x + (y > 7 ? 0.5 : 0.0); }

struct Setting {
  const char* name;
  Noise noise;
};

// Mean of 16 samples of each kind, as a renderer with 16 samples a pixel would make them.
std::vector<Setting> settings() {
  return {
      {"normal noise, a hundredfold variance beside a simple one",
       [](Random& random, int x, int y, int c) {
         const double deviation = (x / 3) % 2 == 0 ? 0.02 : 0.2;
         return static_cast<float>(expected(x, y, c) * (1 + deviation * std::normal_distribution<double>()(random)));
       }},
      {"mean of 16 exponential samples",
       [](Random& random, int x, int y, int c) {
         return static_cast<float>(expected(x, y, c) * std::gamma_distribution<double>(16, 1.0 / 16)(random));
       }},
      {"one sample in ten is bright, the others are black",
       [](Random& random, int x, int y, int c) {
         return static_cast<float>(expected(x, y, c) * 10 * std::binomial_distribution<int>(16, 0.1)(random) / 16);
       }},
      {"log-normal, sigma 1",
       [](Random& random, int x, int y, int c) {
         double sum = 0;
         for (int i = 0; i < 16; ++i) sum += std::exp(std::normal_distribution<double>(-0.5, 1)(random));
         return static_cast<float>(expected(x, y, c) * sum / 16);
       }},
      {"a few pixels see a light that the others do not, one time in twenty",
       [](Random& random, int x, int y, int c) {
         const double base = expected(x, y, c) * std::gamma_distribution<double>(16, 1.0 / 16)(random);
         if ((x + 5 * y) % 7 != 0) return static_cast<float>(base);
         return static_cast<float>(base / 2 + expected(x, y, c) / 2 * 20 *
                                                  std::binomial_distribution<int>(16, 0.05)(random) / 16);
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

/// As a reference is built: the mean of many images, with the variance of that mean.
Rendering reference_of(Random& random, const Noise& noise, int images) {
  std::vector<Image> drawn;
  std::vector<const Image*> pointers;
  for (int i = 0; i < images; ++i) drawn.push_back(draw(random, noise));
  for (const Image& image : drawn) pointers.push_back(&image);
  Rendering reference{mean_of(pointers), Image(width, height), {}};
  for (std::size_t i = 0; i < reference.mean.rgb.size(); ++i) {
    double squares = 0;
    for (const Image& image : drawn)
      squares += std::pow(double{image.rgb[i]} - double{reference.mean.rgb[i]}, 2);
    reference.variance->rgb[i] = static_cast<float>(squares / (images - 1.0) / images);
  }
  return reference;
}

/// The most false alarms in `runs` that a rate of alpha makes with probability 0.95.
double most_alarms(int runs, double alpha) {
  return boost::math::quantile(boost::math::binomial(runs, alpha), 0.95);
}

TEST(gate_statistics, agreement_holds_its_false_alarm_rate_over_all_looks) {
  constexpr int runs = 2000, looks = 2, seeds = 8;
  constexpr double alpha = 0.05;
  // The images' truth is the same; each run has a reference and images of its own. Bounds of 1e-9 are never reached, so
  // that every run takes all its looks.
  for (const Setting& setting : settings()) {
    Random random(7);
    const Rendering reference = reference_of(random, setting.noise, 2000);
    Image least = *reference.variance;
    for (float& value : least.rgb) value *= 2000;
    int alarms = 0;
    for (int run = 0; run < runs; ++run) {
      std::vector<Image> drawn;
      bool alarm = false;
      for (int look = 0; look < looks && !alarm; ++look) {
        while (drawn.size() < static_cast<std::size_t>(seeds) << look) drawn.push_back(draw(random, setting.noise));
        std::vector<const Image*> images;
        for (const Image& image : drawn) images.push_back(&image);
        const Judgement judgement =
            judge_agreement(measure_deviations(reference, 1999, images, &least), {1e-9, 1e-9}, alpha / looks);
        alarm = judgement.verdict == GateVerdict::fail;
      }
      if (alarm) ++alarms;
    }
    std::printf("%s: %d false alarms in %d, alpha %g\n", setting.name, alarms, runs, alpha);
    EXPECT_LE(alarms, most_alarms(runs, alpha)) << setting.name;
  }
}

}  // namespace
}  // namespace photonproof
