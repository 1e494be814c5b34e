#include "harness/diagnosis/whole_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "harness/diagnosis/guess.h"

namespace photonproof::inline harness_diagnosis {

std::optional<Finding> find_noise(const Comparison& comparison, const SceneKnowledge& knowledge) {
  const double noise = comparison.noise(), usual = comparison.noise_of(knowledge.reference);
  // A deviation of 0.04 in square roots is one of 0.08 sqrt(v) in the value: 11 % at half of white.
  if (noise < 0.04 || noise < 2 * usual) return std::nullopt;
  const auto times = [noise](double other) { return noise / std::max(other, 0.004); };
  std::string sentence;
  if (knowledge.baseline) {
    // One render beside one render: the reference is a mean of many. Variance falls as 1/samples.
    const double ratio = times(comparison.noise_of(*knowledge.baseline));
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
