#include "harness/gates/gate_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/gates/unknown_noise.h"
#include "harness/metrics/metrics.h"
#include "harness/pixels/repeated_images.h"
#include "harness/statistics/deviations.h"
#include "harness/statistics/error_shares.h"
#include "reference/store/half_rounding.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_gates {
namespace {

/// The variance of a pixel of one image, from the reference, whose batches had at least as many samples. A sample
/// counts for no less in a small image than in a large one. The result excludes the largest variance that rounding to
/// half floats adds (reference/store/half_rounding.h). Empty where the reference is not made of samples through pixels.
std::optional<Image> variance_by_reference(const Budget& budget, const StoredReference& reference) {
  const Provenance& provenance = reference.provenance;
  if (provenance.estimator == "ptracer" || budget.kind != "spp" || provenance.seeds.empty()) return std::nullopt;
  const auto samples = static_cast<double>(provenance.samples);
  if (samples / static_cast<double>(provenance.seeds.size()) < budget.amount) return std::nullopt;
  Image least = *reference.rendering.variance;
  for (std::size_t i = 0; i < least.rgb.size(); ++i) {
    const double rounding = most_rounding_variance(double{reference.rendering.mean.rgb[i]});
    const double noise = std::max(0.0, double{least.rgb[i]} - rounding);
    least.rgb[i] = static_cast<float>(noise * samples / budget.amount);
  }
  return least;
}

MetricOptions options_for(const Gate& gate, const ParameterValues& viewing) {
  return {.parameters = parameters_of(gate, viewing), .threads = 1, .only = {gate.metric}};
}

/// The metric with the parameters that the gate gives: "flip (exposure=4)".
std::string metric_text(const Gate& gate) {
  return gate.parameters.empty() ? gate.metric : gate.metric + " (" + given_text(gate.parameters) + ")";
}

}  // namespace

double metric_of(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
                 const Image& image) {
  const std::vector<MetricValue> values = compute_metrics(reference.rendering.mean, image, options_for(gate, viewing));
  constexpr double as_good_as_equal = 1000;  // dB: psnr of equal images is infinite and left out
  if (values.empty() && gate.metric == "psnr") return as_good_as_equal;
  if (values.empty())
    throw InputError(gate.name, gate.metric + " is undefined: " + find_metric(gate.metric)->undefined_when);
  return values.front().value;
}

Judgement look_at_values(const Gate& gate, std::span<const double> values) {
  return judge_metric(metric_text(gate), values, find_metric(gate.metric)->bound, gate.bound, gate.alpha / gate.looks);
}

namespace {

Judgement without_numbers(std::optional<GateVerdict> verdict, std::string sentence) {
  Judgement judgement;
  judgement.verdict = verdict;
  judgement.sentence = std::move(sentence);
  return judgement;
}

double channel_mean(const Image& image, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.rgb.size(); i += 3) sum += double{image.rgb[i]};
  return sum / static_cast<double>(image.pixels());
}

/// The verdict on identical images, with their deviation but without an interval.
Judgement of_identical(GateVerdict verdict, std::string sentence, const StoredReference& reference,
                       const Image& image) {
  Judgement judgement = without_numbers(verdict, std::move(sentence));
  judgement.observed.value = worst_whole(reference.rendering.mean, image).value_or(0);
  return judgement;
}

/// A golden image that states no noise may have any.
bool expects_noise(const StoredReference& reference) {
  return has_noise(reference.rendering) || has_unknown_noise(reference.provenance);
}

std::string all_the_same(const Gate& gate, std::size_t images) {
  return gate.takes_seed ? fmt::format("all {} seeds gave the same image", images)
                         : fmt::format("all {} images are the same and the engine's command has no {{seed}}", images);
}

/// The reason why these images cannot be judged or prove nothing. Empty where they can be judged.
std::optional<Judgement> fault_of_seeds(const Gate& gate, const StoredReference& reference,
                                        std::span<const Image* const> images, const Repeats& repeats) {
  // Images that differ in fewer values than this may be equal elsewhere by chance, when their noise is coarse.
  constexpr std::size_t least_difference = 64;
  if (std::any_of(images.begin(), images.end(),
                  [&](const Image* image) { return is_copy(reference.rendering, *image); }))
    return without_numbers(GateVerdict::fail, "an image is the reference itself, bit for bit, and not a rendering");
  if (repeats.different == repeats.images || !expects_noise(reference)) return std::nullopt;
  if (repeats.different > 1) {
    if (repeats.least_difference < least_difference) return std::nullopt;
    return without_numbers(
        GateVerdict::fail,
        fmt::format("{} images, only {} of them different: repeated images count their noise more than once",
                    repeats.images, repeats.different));
  }
  if (!weighs_noise(gate.metric)) return std::nullopt;
  const Image& image = *images.front();
  if (std::ranges::all_of(image.rgb, [](float value) { return value == 0; }))
    return of_identical(GateVerdict::fail, fmt::format("All {} images are black: -100 % everywhere", repeats.images),
                        reference, image);
  // An unbiased engine's images have noise; POV-Ray's have none, with any seed, where nothing is random.
  if (gate.takes_seed && gate.unbiased)
    return of_identical(
        GateVerdict::fail,
        fmt::format("All {} images are identical. The command probably ignores {{seed}}", repeats.images), reference,
        image);
  return of_identical(GateVerdict::inconclusive,
                      fmt::format("{}: {} needs noise, and identical images show none; bound a metric of compare "
                                  "instead (relmse, ssim ...)",
                                  all_the_same(gate, repeats.images), gate.metric),
                      reference, image);
}

Judgement look_at_metric(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
                         std::span<const Image* const> images, const Repeats& repeats) {
  std::vector<double> values;
  for (const Image* image : images) values.push_back(metric_of(gate, reference, viewing, *image));
  Judgement judgement = look_at_values(gate, values);
  if (repeats.different == 1 && expects_noise(reference))
    judgement.sentence = all_the_same(gate, repeats.images) + ": " + judgement.sentence;
  if (judgement.verdict != GateVerdict::fail) return judgement;
  judgement.tiles = largest_error_shares(gate.metric, reference.rendering.mean, images, options_for(gate, viewing));
  if (!judgement.tiles.empty()) judgement.sentence += "; " + judgement.tiles.front().sentence;
  return judgement;
}

}  // namespace

std::optional<double> worst_whole(const Image& reference, const Image& image) {
  std::optional<double> worst;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double expected = channel_mean(reference, channel);
    if (expected == 0) continue;
    const double off = channel_mean(image, channel) / expected - 1;
    if (!worst || std::abs(off) > std::abs(*worst)) worst = off;
  }
  return worst;
}

Deviations deviations_of(bool unbiased, const Budget& budget, const StoredReference& reference,
                         std::span<const Image* const> images) {
  const std::optional<Image> least = unbiased ? variance_by_reference(budget, reference) : std::nullopt;
  KnownNoise known{.reference_freedom = freedom_of(reference.provenance), .least_variance = least ? &*least : nullptr};
  if (budget.kind == "spp") known.samples = budget.amount;
  if (has_unknown_noise(reference.provenance))
    return measure_deviations(with_estimated_noise(reference.rendering, images), images, known);
  return measure_deviations(reference.rendering, images, known);
}

Judgement look_at(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
                  std::span<const Image* const> images) {
  const Repeats repeats = count_repeats(images);
  if (const auto fault = fault_of_seeds(gate, reference, images, repeats)) return *fault;
  if (!weighs_noise(gate.metric)) return look_at_metric(gate, reference, viewing, images, repeats);
  const double alpha = gate.alpha / gate.looks;
  const Deviations deviations = deviations_of(gate.unbiased, gate.budget, reference, images);
  if (gate.metric == agreement_metric) return judge_agreement(deviations, {gate.bound, gate.block_bound}, alpha);
  return judge_bias(deviations, gate.metric == block_bias_metric, gate.bound, alpha);
}

ParameterValues parameters_of(const Gate& gate, const ParameterValues& viewing) {
  return with_given(viewing, gate.parameters);
}

}  // namespace photonproof::inline harness_gates
