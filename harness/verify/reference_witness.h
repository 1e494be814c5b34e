// The independent check of a reference: chooses a second estimator that finds its light by other code, and tests
// whether the two agree.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/statistics/batch_means.h"
#include "harness/verify/picture_pair.h"
#include "scenes/description/description.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_verify {

/// The unbiased estimator that shares the least with `parent`. It shares no sampling, shows all of the scene's light
/// and is not refused. Empty if there is none. `refusal` as in choose_estimator.
std::string witness_for(const SceneDescription& scene, const std::string& parent, const std::optional<Expect>& expect,
                        const std::function<std::string(const std::string& integrator)>& refusal);

/// Compares means over the image and over blocks of 8 x 8 pixels: a few dozen batches give single pixels' variances too
/// badly. Beyond noise, two right estimators may differ by 0.2 % of the mean and 2 % of a block, since pixels of one
/// batch share light paths. `bias` is the reference's, as stated by its estimator.
PairTest test_witness(const Rendering& reference, double bias, const Rendering& witness);

}  // namespace photonproof::inline harness_verify
