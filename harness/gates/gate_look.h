// One look of a gate: the verdict on the images so far, at the look's part of the gate's alpha.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/gates/gate_suite.h"
#include "harness/statistics/gate_statistics.h"
#include "reference/store/reference_store.h"

namespace photonproof::inline harness_gates {

/// The parameters of a gate's metric: the scene's, except those that the gate gives.
ParameterValues parameters_of(const Gate& gate, const ParameterValues& viewing);

/// The deviations of an engine's images of one budget. The noise of an unbiased engine, ours or not, is taken to be at
/// least that of the reference's samples (KnownNoise::least_variance). Images as in deviations.h.
Deviations deviations_of(bool unbiased, const Budget& budget, const StoredReference& reference,
                         std::span<const Image* const> images);

/// The whole image's largest relative difference of a channel; empty where the reference is black.
std::optional<double> worst_whole(const Image& reference, const Image& image);

/// Images as in deviations.h. Images that prove nothing (repeated_images.h) are judged first:
/// * An image that is the reference itself fails every gate.
/// * Where the reference has noise, one image for all seeds fails gates that weigh noise. It is inconclusive without
///   {seed} in the command or for a biased engine, but black images fail. Other gates name it.
/// * Repeated images among different ones fail.
Judgement look_at(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
                  std::span<const Image* const> images);

/// The one number of each image for gates that do not weigh noise (gate_metrics.h); later looks need not compute it
/// again. Throws InputError when the metric is undefined for these images.
double metric_of(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
                 const Image& image);
Judgement look_at_values(const Gate& gate, std::span<const double> values);

}  // namespace photonproof::inline harness_gates
