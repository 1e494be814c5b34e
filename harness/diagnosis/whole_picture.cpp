#include "harness/diagnosis/whole_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "harness/diagnosis/guess.h"

namespace photonproof {

std::optional<Finding> find_noise(const Comparison& comparison, const SceneKnowledge& knowledge) {
  const double noise = comparison.noise(), usual = comparison.noise_of(knowledge.reference);
  // A deviation of 0.04 in square roots is one of 0.08 sqrt(v) in the value: 11 % at half of white.
  if (noise < 0.04 || noise < 2 * usual) return std::nullopt;
  const double ratio = noise / std::max(usual, 0.004);
  std::string sentence = "noisy: about " + factor_text(ratio) + " times the reference's noise";
  sentence += ", as with 1/" + std::to_string(static_cast<int>(ratio * ratio + 0.5)) + " of its samples";
  return Finding{"noise",
                 sentence,
                 "too few samples or photons, or they are drawn badly",
                 {0, 0, comparison.width(), comparison.height()},
                 0};
}

}  // namespace photonproof
