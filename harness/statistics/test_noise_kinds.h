// Kinds of noise for tests of verdicts: each made of known parts, with the expectation `truth`.
#pragma once

#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::noise_kinds {

using Random = std::mt19937_64;
inline constexpr int side = 32, samples = 16;

inline double truth(int x, int y, int c) { return 0.2 + 0.05 * c + 0.02 * x + (y > 12 ? 0.5 : 0.0); }

/// A value over its expectation, by pixel; drawn anew for each image, so that a kind can keep its image's common part.
using Factor = std::function<double(Random&, int x, int y)>;
struct Kind {
  const char* name;
  std::function<Factor(Random&)> image;
};

inline double normal(Random& random, double mean, double deviation) {
  return std::normal_distribution<double>(mean, deviation)(random);
}

inline Kind by_pixel(const char* name, const Factor& factor) {
  return {name, [factor](Random&) { return factor; }};
}

/// 16 samples a pixel. One in `one_in` brings `share` of the light, the others the rest with 10 % of noise.
inline Kind rare(const char* name, double share, double one_in) {
  return by_pixel(name, [=](Random& random, int, int) {
    const int met = std::poisson_distribution<int>(samples / one_in)(random);
    return (1 - share) * normal(random, 1, 0.1) + share * met * one_in / samples;
  });
}

/// 10 % of noise a pixel, and `deviation` that the pixels of a square, or of the image, share.
inline Kind shared(const char* name, int square, double deviation) {
  return {name, [=](Random& random) -> Factor {
            std::vector<double> parts(static_cast<std::size_t>(side * side));
            for (double& part : parts) part = normal(random, 0, deviation);
            return [=](Random& pixel, int x, int y) {
              return normal(pixel, 1, 0.1) + parts[static_cast<std::size_t>(y / square * side + x / square)];
            };
          }};
}

inline double mean_of_log_normals(Random& random) {
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += std::exp(normal(random, -0.5, 1));
  return sum / samples;
}

inline std::vector<Kind> kinds() {
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

inline Image drawn(Random& random, const Kind& kind) {
  Image image(side, side);
  const Factor factor = kind.image(random);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<float>(truth(x, y, c) * factor(random, x, y));
  return image;
}

inline Rendering known_reference() {
  Rendering reference{Image(side, side), Image(side, side), {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c) {
        reference.mean.pixel(x, y)[c] = static_cast<float>(truth(x, y, c));
        reference.variance->pixel(x, y)[c] = static_cast<float>(std::pow(1e-4 * truth(x, y, c), 2));
      }
  return reference;
}

/// The value of PHOTONPROOF_NULL_RUNS, else `usual`.
inline int asked_runs(int usual) {
  const char* asked = std::getenv("PHOTONPROOF_NULL_RUNS");
  return asked != nullptr ? std::atoi(asked) : usual;
}

}  // namespace photonproof::noise_kinds
