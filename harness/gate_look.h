// One look of a gate: what the images so far say, at the look's part of the gate's alpha.
#pragma once

#include <span>
#include <vector>

#include "harness/gate_statistics.h"
#include "harness/gate_suite.h"
#include "reference/reference_store.h"

namespace photonproof {

/// Images as in deviations.h. Metrics that are display-encoded use the scene's `exposure`.
Judgement look_at(const Gate& gate, const StoredReference& reference, double exposure,
                  std::span<const Image* const> images);

/// Gates on a metric of `compare` need one number of each image, which need not be computed again at the next look.
bool is_metric_of_one_image(const Gate& gate);
/// Throws InputError when the metric is undefined for these images.
double metric_of(const Gate& gate, const StoredReference& reference, double exposure, const Image& image);
Judgement look_at_values(const Gate& gate, std::span<const double> values);

/// As the suite says it, else the scene's expect.toml. Throws InputError.
double exposure_of(const SuiteScene& scene);

}  // namespace photonproof
