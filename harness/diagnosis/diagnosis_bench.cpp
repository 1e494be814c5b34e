// The time of a diagnosis of a picture of 512 x 512 pixels on one thread, without a model of the scene's light.

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {
namespace {

constexpr int side = 512;

/// A disc before a wall of many shades, with noise.
Image picture(unsigned seed, double (*change)(double value, int x, int y)) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.02);
  Image image(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c) {
        const bool disc = std::hypot(x - 300, y - 200) < 90;
        const double wall = 0.25 + 0.15 * std::sin(x / 37.0 + c) * std::cos(y / (23.0 + 5 * c));
        const double value = (disc ? 0.5 : wall) * (1 + noise(random));
        image.pixel(x, y)[c] = static_cast<float>(change(value, x, y));
      }
  return image;
}

void diagnose_512(benchmark::State& state, double (*change)(double value, int x, int y)) {
  SceneKnowledge knowledge;
  knowledge.reference = picture(1, [](double value, int, int) { return value; });
  knowledge.white = 1.0f;
  const Image submitted = picture(2, change);
  for (auto _ : state) benchmark::DoNotOptimize(diagnose(submitted, knowledge));
}
BENCHMARK_CAPTURE(diagnose_512, right, [](double value, int, int) { return value; })->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(diagnose_512, dim, [](double value, int, int) { return 0.7 * value; })->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(diagnose_512, square_root, [](double value, int, int) {
  return std::sqrt(value);
})->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(diagnose_512, strange, [](double value, int x, int y) {
  return value * (1 + 0.4 * std::sin(x / 20.0) * std::cos(y / 33.0));
})->Unit(benchmark::kSecond);

}  // namespace
}  // namespace photonproof::inline harness_diagnosis
