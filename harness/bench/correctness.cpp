#include "harness/bench/correctness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/gates/gate_look.h"
#include "harness/gates/independence.h"
#include "harness/pixels/repeated_images.h"

namespace photonproof {
namespace {

/// "+0.8 % overall", the worst channel's.
std::string overall(double relative) { return fmt::format("{:+.2g} % overall", 100 * relative); }

double channel_mean(const Image& image, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.rgb.size(); i += 3) sum += double{image.rgb[i]};
  return sum / static_cast<double>(image.pixels());
}

/// The whole image's largest relative difference of a channel; empty where the reference is black.
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

CorrectnessRecord unknown(std::string why) {
  CorrectnessRecord record;
  record.sentence = std::move(why);
  return record;
}

// A count of which this is the mean is 0 with probability 1e-3.
constexpr double rarely_none = 7;

// Whether a few bright samples, met or missed, would make up what an unbiased engine's images are off by. No variance
// knows of those, but other places met some: where as much light is missing as `rarely_none` samples of the brightest
// kind would bring, they should have been met here, too.
bool rare_samples_explain(const Image& reference, std::span<const Image> images, double spp,
                          const Judgement& judgement) {
  std::vector<FailingTile> places = judgement.tiles;
  if (places.empty()) {
    const Interval whole = judgement.observed.interval.value_or(Interval{});
    if (whole.low <= 0 && whole.high >= 0) return false;  // single pixels, or blocks that only together are off
    places.push_back({0, 0, reference.width, reference.height, 0, {}});
  }
  for (std::size_t c = 0; c < 3; ++c) {
    double brightest = 0;  // of one sample, beyond what is expected
    for (const Image& image : images)
      for (std::size_t i = c; i < image.rgb.size(); i += 3)
        brightest = std::max(brightest, double{image.rgb[i] - reference.rgb[i]} * spp);
    for (const FailingTile& place : places) {
      double missing = 0;  // sum over the samples
      for (int y = place.y; y < place.y + place.height; ++y)
        for (int x = place.x; x < place.x + place.width; ++x)
          for (const Image& image : images) missing += double{reference.pixel(x, y)[c] - image.pixel(x, y)[c]} * spp;
      if (std::abs(missing) > rarely_none * brightest) return false;
    }
  }
  return true;
}

}  // namespace

std::string doubt_of(const Engine& engine) {
  if (engine.trust == Trust::unbiased) return {};
  return "the reference is by " + engine.name + ", which " +
         (engine.trust == Trust::biased ? "is biased" : "nothing vouches for");
}

CorrectnessRecord judge_correctness(const Judge& judge, const Engine& engine, const Budget& budget,
                                    std::span<const Image> images) {
  if (judge.reference == nullptr || images.empty()) return unknown("there is nothing to compare with");
  if (!judge.doubt.empty()) return unknown(judge.doubt);
  const Rendering& reference = judge.reference->rendering;
  if (!reference.variance) return unknown("the reference does not say how noisy it is");
  for (const Image& image : images)
    if (image.rgb == reference.mean.rgb) return unknown("an image equals the reference to the bit");
  if (images.size() < 2) {
    CorrectnessRecord record = unknown("one seed: nothing tells its noise from an error");
    if (const auto off = worst_whole(reference.mean, images.front())) {
      record.whole = Estimate{*off, {}};
      record.sentence += "; it is " + overall(*off);
    }
    return record;
  }
  std::vector<const Image*> pointers;
  for (const Image& image : images) pointers.push_back(&image);
  const Judgement judgement =
      judge_agreement(deviations_of(engine.trust == Trust::unbiased, budget, *judge.reference, pointers),
                      {right_within, right_within_in_a_block}, correctness_alpha);
  CorrectnessRecord record;
  record.verdict = !judgement.verdict                        ? Correctness::noisy
                   : *judgement.verdict == GateVerdict::pass ? Correctness::right
                                                             : Correctness::biased;
  if (record.verdict == Correctness::biased && engine.trust == Trust::unbiased && budget.kind == "spp" &&
      rare_samples_explain(reference.mean, images, budget.amount, judgement)) {
    record.verdict = Correctness::noisy;
    record.sentence = "too few samples to meet rare bright ones: ";
  }
  record.sentence +=
      (count_repeats(pointers).different == 1 ? "all seeds gave the same image; " : "") + judgement.sentence;
  if (judgement.observed.interval) record.whole = judgement.observed;
  record.would_see = judgement.would_see;
  record.would_see_in_a_block = judgement.would_see_in_a_block;
  record.regression_only =
      regression_only(engine, *judge.reference, judge.expect == nullptr ? std::nullopt : *judge.expect);
  return record;
}

void reconcile(std::span<CurvePoint> points) {
  const CurvePoint* acquitted = nullptr;
  for (std::size_t i = points.size(); i-- > 0;) {
    auto& record = points[i].correctness;
    if (!record) continue;
    if (record->verdict == Correctness::biased && acquitted != nullptr) {
      record->verdict = Correctness::noisy;
      record->sentence = "too few samples to meet rare bright ones, for " + acquitted->budget.label() +
                         " does not show this: " + record->sentence;
    } else if (record->verdict == Correctness::right || record->verdict == Correctness::noisy) {
      acquitted = &points[i];
    }
  }
}

}  // namespace photonproof
