// Whether the images of a benchmark's budget show what they should: right, noisy, biased or unknown. The test is the
// gates' `agreement` (gate_statistics.h) on the images of the budget's seeds, one look. That a cell finished says
// nothing of this.
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

/// `right` means that an error of the whole image, or of a block of 8 x 8 pixels, as large as this would have been seen
/// with probability 0.99; the bounds of the gates that come with this program.
inline constexpr double right_within = 0.02, right_within_in_a_block = 0.2;
/// Of calling a right image biased.
inline constexpr double correctness_alpha = 0.001;

/// Why a reference by this engine convicts nobody: "the reference is by photonmapper, which is biased". Empty for an
/// unbiased one.
std::string doubt_of(const Engine& engine);

/// What a budget's images are judged by.
struct Judge {
  const StoredReference* reference =
      nullptr;        ///< null: there is none. Its variance may be missing, then nothing is said
  std::string doubt;  ///< as SceneRecord::reference_doubt
  const std::optional<Expect>* expect = nullptr;  ///< of the scene, for independence.h
};

/// `images` are of one budget's seeds, each of the reference's size and finite.
CorrectnessRecord judge_correctness(const Judge& judge, const Engine& engine, const Budget& budget,
                                    std::span<const Image> images);

/// Of one unbiased engine on one scene: what a budget's images lack although a larger budget's images do not is rare
/// bright samples that it has not met, so its verdict becomes noisy. `points` ascend.
void reconcile(std::span<CurvePoint> points);

}  // namespace photonproof::inline harness_bench
