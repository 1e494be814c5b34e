// The second parent of a reference: an estimator that finds its light by other code than the first, and whether the two
// agree.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/statistics/batch_means.h"
#include "harness/verify/picture_pair.h"
#include "scenes/description/description.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_verify {

/// Of the estimators that are unbiased here the one with the least in common with `parent`: it shares no sampling with
/// it, shows all of the scene's light and is not refused; empty where there is none. `refusal` as choose_estimator's.
std::string witness_for(const SceneDescription& scene, const std::string& parent, const std::optional<Expect>& expect,
                        const std::function<std::string(const std::string& integrator)>& refusal);

/// Means over the image and over blocks of 8 x 8 pixels: variances of single pixels are known too badly by a few dozen
/// batches. Two right estimators may differ by 0.2 % of the mean and 2 % of a block beyond noise, since pixels of one
/// batch share light paths. `bias`: of the reference, as its estimator states it.
PairTest test_witness(const Rendering& reference, double bias, const Rendering& witness);

}  // namespace photonproof::inline harness_verify
