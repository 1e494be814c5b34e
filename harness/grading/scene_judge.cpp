#include "harness/grading/scene_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/metrics/metrics.h"
#include "harness/statistics/gate_statistics.h"
#include "harness/statistics/student.h"

namespace photonproof::inline harness_grading {
namespace {

constexpr double level = 0.01;  // two-sided level of a metric's interval
constexpr const char* blocks_check = "blocks";
constexpr double near_share = 0.25;  // fraction of the bound's scale: values nearer than this need more than one image

using Side = GradedCheck::Side;

// The scale of a bound: a bound of 0.95 on ssim is as strict as one of 0.05 on its distance from 1.
double scale_of_bound(const MetricBound& bound) {
  if (bound.metric->bound != BoundKind::minimum) return std::abs(bound.bound);
  return bound.bound <= 1 ? 1 - bound.bound : 20;
}

Side side_of_interval(const MetricBound& bound, double low, double high) {
  if (bound.metric->bound == BoundKind::minimum) {
    if (low >= bound.bound) return Side::inside;
    return high < bound.bound ? Side::outside : Side::undecided;
  }
  if (bound.metric->bound == BoundKind::maximum) {
    if (high <= bound.bound) return Side::inside;
    return low > bound.bound ? Side::outside : Side::undecided;
  }
  if (low >= -bound.bound && high <= bound.bound) return Side::inside;
  return low > bound.bound || high < -bound.bound ? Side::outside : Side::undecided;
}

std::string check_sentence(const GradedCheck& check, BoundKind kind) {
  const char* const relation = kind == BoundKind::minimum ? "at least" : "at most";
  return fmt::format("{} is {:.3g}, {} {:.3g} is right", check.metric, check.value.value, relation, check.bound);
}

GradedCheck check_metric(const MetricBound& bound, const Image& reference, std::span<const Image* const> images) {
  GradedCheck check;
  check.metric = bound.metric->name;
  check.bound = bound.bound;
  std::vector<double> values;
  for (const Image* image : images) {
    const std::vector<MetricValue> found = compute_metrics(reference, *image, {.only = {check.metric}});
    if (found.empty()) continue;  // an infinite psnr: images that are equal once encoded
    values.push_back(found.front().value);
    check.parameters = found.front().parameters;
  }
  if (values.empty()) {
    check.sentence = check.metric + " has no value here";
    check.side = bound.metric->bound == BoundKind::minimum && check.metric == "psnr" ? Side::inside : Side::outside;
    return check;
  }
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  double margin = near_share * scale_of_bound(bound);
  if (values.size() > 1) margin = t_quantile(level / 2, n - 1) * std::sqrt(squares / (n - 1) / n);
  check.value = {mean, Interval{mean - margin, mean + margin}};
  check.side = side_of_interval(bound, mean - margin, mean + margin);
  check.sentence = check_sentence(check, bound.metric->bound);
  return check;
}

// Where there can be no second image, noise is unknown, and the image's value decides.
void decide_by_value(const MetricBound& bound, GradedCheck& check) {
  if (check.side != Side::undecided) return;
  check.side = side_of_interval(bound, check.value.value, check.value.value);
}

GradedCheck check_blocks(const BlockBound& bound, const SceneReference& reference,
                         std::span<const Image* const> images) {
  GradedCheck check;
  check.metric = blocks_check;
  check.bound = bound.relative;
  check.parameters = fmt::format("alpha={:.3g}", bound.alpha);
  // A single image stands for a program without noise until there is a second one.
  const std::array<const Image*, 2> pair{images.front(), images.front()};
  if (images.size() == 1) images = pair;
  const Deviations deviations =
      measure_deviations(reference.rendering, images, {.reference_freedom = reference.freedom});
  const Judgement judgement = judge_bias(deviations, true, bound.relative, bound.alpha);
  check.value = judgement.observed;
  check.side = !judgement.verdict                        ? Side::undecided
               : *judgement.verdict == GateVerdict::fail ? Side::outside
                                                         : Side::inside;
  check.sentence = judgement.sentence;
  return check;
}

bool are_all_alike(std::span<const Image* const> images) {
  return std::ranges::all_of(images, [&](const Image* image) { return image->rgb == images.front()->rgb; });
}

/// Undecided blocks do not count: where they are too noisy, more images seldom help. Diagnosis, which knows the
/// patterns of mistakes, then finds more (scene_findings.h).
bool has_side(const std::vector<GradedCheck>& checks, Side side) {
  return std::ranges::any_of(checks, [&](const GradedCheck& check) {
    return check.side == side && (side == Side::outside || check.metric != blocks_check);
  });
}

void conclude(SceneJudgement& judgement) {
  judgement.verdict = has_side(judgement.checks, Side::outside)     ? SceneVerdict::wrong
                      : has_side(judgement.checks, Side::undecided) ? SceneVerdict::borderline
                                                                    : SceneVerdict::right;
  if (judgement.verdict == SceneVerdict::right) return;
  for (const Side side : {Side::outside, Side::undecided})
    for (const GradedCheck& check : judgement.checks)
      if (judgement.sentence.empty() && check.side == side) judgement.sentence = check.sentence;
  if (judgement.verdict == SceneVerdict::borderline)
    judgement.sentence = "noise leaves it open, which counts as right: " + judgement.sentence;
}

}  // namespace

Image variance_of_one(const SceneReference& reference) {
  Image variance = *reference.rendering.variance;
  for (float& v : variance.rgb) v *= static_cast<float>(reference.images);
  return variance;
}

double partial_share(const CorrectnessRule& rule, const SceneReference& reference,
                     std::span<const Image* const> images) {
  if (!rule.partial || images.empty()) return 0;
  const auto& [metric, full, none] = *rule.partial;
  double mean = 0;
  for (const Image* image : images) {
    const auto found = compute_metrics(reference.rendering.mean, *image, {.only = {metric->name}});
    if (found.empty()) return 0;
    const double value =
        metric->bound == BoundKind::absolute_maximum ? std::abs(found.front().value) : found.front().value;
    mean += value / static_cast<double>(images.size());
  }
  return std::clamp((mean - none) / (full - none), 0.0, 1.0);
}

SceneJudgement judge_scene(const CorrectnessRule& rule, const SceneReference& reference,
                           std::span<const Image* const> images, bool may_draw) {
  SceneJudgement judgement;
  for (const MetricBound& bound : rule.metrics) {
    GradedCheck check = check_metric(bound, reference.rendering.mean, images);
    if (!may_draw && images.size() == 1) decide_by_value(bound, check);
    judgement.checks.push_back(std::move(check));
  }
  // An image that a metric rejects needs no further images.
  const bool is_refused = has_side(judgement.checks, Side::outside);
  bool needs_second = false;
  if (rule.blocks && !is_refused) {
    judgement.checks.push_back(check_blocks(*rule.blocks, reference, images));
    // One image does not show the program's noise: a block that is outside may be chance.
    needs_second = images.size() == 1 && judgement.checks.back().side == Side::outside;
  }
  const bool has_no_noise = images.size() > 1 && are_all_alike(images);
  const bool is_open = !is_refused && (needs_second || has_side(judgement.checks, Side::undecided));
  judgement.decided = !is_open || has_no_noise || !may_draw;
  conclude(judgement);
  return judgement;
}

}  // namespace photonproof::inline harness_grading
