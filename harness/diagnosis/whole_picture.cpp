#include "harness/diagnosis/whole_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "harness/diagnosis/guess.h"
#include "harness/pixels/middle_of.h"

namespace photonproof::inline harness_diagnosis {

namespace {

/// The deviation of a pixel's noise, in units of Comparison::shown(). It uses the median difference of a value from the
/// middle of its four neighbours, which single black or bright pixels do not change. For normal noise of deviation 1,
/// that difference has deviation sqrt(1 + 0.3), and its absolute value the median 0.77.
double grain_of(const Comparison& comparison, const Image& image) {
  std::vector<double> differences;
  const auto shown = [&](int x, int y, int c) { return comparison.shown(image.pixel(x, y)[c]); };
  for (int y = 1; y + 1 < image.height; ++y)
    for (int x = 1; x + 1 < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        std::array<double, 4> around{shown(x - 1, y, c), shown(x + 1, y, c), shown(x, y - 1, c), shown(x, y + 1, c)};
        std::sort(around.begin(), around.end());
        differences.push_back(std::abs(shown(x, y, c) - (around[1] + around[2]) / 2));
      }
  return middle_of(std::move(differences)) / 0.77;
}

}  // namespace

std::optional<Finding> find_noise(const Comparison& comparison, const SceneKnowledge& knowledge) {
  const double noise = grain_of(comparison, comparison.submitted()), usual = grain_of(comparison, knowledge.reference);
  // A deviation of 0.04 in square roots is one of 0.08 sqrt(v) in the value: 11 % at half of white.
  if (noise < 0.04 || noise < 2 * usual) return std::nullopt;
  const auto times = [noise](double other) { return noise / std::max(other, 0.004); };
  std::string sentence;
  if (knowledge.baseline) {
    // The baseline is one render, too; the reference is a mean of many. Variance falls as 1/samples.
    const double ratio = times(grain_of(comparison, *knowledge.baseline));
    sentence = fmt::format("noisy: about {} times the baseline's noise", factor_text(ratio));
    if (ratio * ratio >= 1.5) sentence += fmt::format(", as with 1/{:.0f} of its samples", ratio * ratio);
  } else {
    sentence = fmt::format("noisy: about {} times the reference's noise", factor_text(times(usual)));
  }
  return Finding{"noise",
                 sentence,
                 "too few samples or photons, or they are drawn badly",
                 {0, 0, comparison.width(), comparison.height()},
                 0};
}

}  // namespace photonproof::inline harness_diagnosis
