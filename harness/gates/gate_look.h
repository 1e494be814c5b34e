// One look of a gate: what the images so far say, at the look's part of the gate's alpha.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/gates/gate_suite.h"
#include "harness/statistics/gate_statistics.h"
#include "reference/store/reference_store.h"

namespace photonproof::inline harness_gates {

/// The parameters that a scene pins: its exposure as the suite says it, else its expect.toml, which alone may pin
/// hdr_exposures. Throws InputError.
ParameterValues viewing_of(const SuiteScene& scene);

/// Those that a gate's metric is computed with: the scene's, but for what the gate gives itself.
ParameterValues parameters_of(const Gate& gate, const ParameterValues& viewing);

/// Of an engine's images of one budget, with what is known of their noise: that of an unbiased engine is not taken to
/// be less than the reference's samples had, whoever made them (KnownNoise::least_variance). Images as in deviations.h.
Deviations deviations_of(bool unbiased, const Budget& budget, const StoredReference& reference,
                         std::span<const Image* const> images);

/// The whole image's largest relative difference of a channel; empty where the reference is black.
std::optional<double> worst_whole(const Image& reference, const Image& image);

/// Images as in deviations.h. Those that prove nothing (repeated_images.h) are judged first: one that is the reference
/// itself fails every gate; where the reference has noise, the same image for all seeds fails what weighs noise
/// (nothing can be said without {seed} in the command, or where the engine does not claim to be unbiased; black ones
/// are wrong whoever made them), and is named by the other gates; images that repeat among others fail.
Judgement look_at(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
                  std::span<const Image* const> images);

/// Gates that do not weigh noise (gate_metrics.h) need one number of each image, which need not be computed again at
/// the next look. Throws InputError when the metric is undefined for these images.
double metric_of(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
                 const Image& image);
Judgement look_at_values(const Gate& gate, std::span<const double> values);

}  // namespace photonproof::inline harness_gates
