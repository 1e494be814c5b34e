// Verdict on the images of one budget of a benchmark: right, noisy, biased or unknown. The test is the gates'
// `agreement` (gate_statistics.h) with one look at the images of all seeds. A finished cell alone proves nothing.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "harness/suites/engines.h"
#include "reference/store/reference_store.h"
#include "reports/record/results.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_bench {

/// `right` means that the test finds an error of this size in the whole image, or in a block of 8 x 8 pixels, with
/// probability 0.99. The sizes are the bounds of the gates that come with this program.
inline constexpr double right_within = 0.02, right_within_in_a_block = 0.2;
/// Probability that a right image is called biased.
inline constexpr double correctness_alpha = 0.001;

/// The reason why no verdict is based on a reference by this engine: "the reference is by photonmapper, which is
/// biased". Empty for an unbiased engine.
std::string doubt_of(const Engine& engine);

/// The reference and the expectations that a budget's images are compared with.
struct Judge {
  /// Null: there is none. It may lack a variance, and then the verdict is unknown.
  const StoredReference* reference = nullptr;
  std::string doubt;                              ///< as SceneRecord::reference_doubt
  const std::optional<Expect>* expect = nullptr;  ///< of the scene, for independence.h
};

/// `images` are of one budget's seeds, each of the reference's size and finite.
CorrectnessRecord judge_correctness(const Judge& judge, const Engine& engine, const Budget& budget,
                                    std::span<const Image> images);

/// For one unbiased engine on one scene: light that a budget's images lack and a larger budget's images have comes from
/// rare bright samples that the smaller budget missed. So its verdict becomes noisy. `points` ascend.
void reconcile(std::span<ConvergencePoint> points);

}  // namespace photonproof::inline harness_bench
