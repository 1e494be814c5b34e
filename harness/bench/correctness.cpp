#include "harness/bench/correctness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/gates/gate_look.h"
#include "harness/gates/independence.h"
#include "harness/pixels/repeated_images.h"
#include "scenes/base/percent_text.h"

namespace photonproof::inline harness_bench {
namespace {

/// "+0.8 % overall", for the worst channel.
std::string overall(double relative) { return signed_percent_text(relative) + " overall"; }

CorrectnessRecord unknown(std::string why) {
  CorrectnessRecord record;
  record.sentence = std::move(why);
  return record;
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
  if (!reference.variance) return unknown("the reference has no variance");
  for (const Image& image : images)
    if (image.rgb == reference.mean.rgb) return unknown("an image equals the reference to the bit");
  std::vector<const Image*> pointers;
  for (const Image& image : images) pointers.push_back(&image);
  if (images.size() < std::size_t{least_images}) {
    CorrectnessRecord record =
        unknown(images.size() == 1 ? "one seed: its noise cannot be separated from an error"
                                   : "two seeds: skewed noise cannot be separated from an error; three seeds suffice");
    if (const auto off = worst_whole(reference.mean, mean_of(pointers))) {
      record.whole = Estimate{*off, {}};
      record.sentence += images.size() == 1 ? "; it is " : "; they are ";
      record.sentence += overall(*off);
    }
    return record;
  }
  const Deviations deviations = deviations_of(engine.trust == Trust::unbiased, budget, *judge.reference, pointers);
  const Judgement judgement = judge_agreement(deviations, {right_within, right_within_in_a_block}, correctness_alpha);
  CorrectnessRecord record;
  record.verdict = !judgement.verdict                        ? Correctness::noisy
                   : *judgement.verdict == GateVerdict::pass ? Correctness::right
                                                             : Correctness::biased;
  record.sentence =
      (count_repeats(pointers).different == 1 ? "all seeds gave the same image; " : "") + judgement.sentence;
  if (judgement.observed.interval) record.whole = judgement.observed;
  // With a bound of 0 this is the block that is surest to be off.
  if (record.verdict == Correctness::biased) record.block = judge_bias(deviations, true, 0, correctness_alpha).observed;
  record.would_see = judgement.would_see;
  record.would_see_in_a_block = judgement.would_see_in_a_block;
  record.regression_only =
      regression_only(engine, *judge.reference, judge.expect == nullptr ? std::nullopt : *judge.expect);
  return record;
}

void reconcile(std::span<ConvergencePoint> points) {
  const ConvergencePoint* acquitted = nullptr;
  for (std::size_t i = points.size(); i-- > 0;) {
    auto& record = points[i].correctness;
    if (!record) continue;
    if (record->verdict == Correctness::biased && acquitted != nullptr) {
      record->verdict = Correctness::noisy;
      record->block.reset();
      record->sentence = "too few samples to meet rare bright ones, for " + acquitted->budget.label() +
                         " does not show this: " + record->sentence;
    } else if (record->verdict == Correctness::right || record->verdict == Correctness::noisy) {
      acquitted = &points[i];
    }
  }
}

}  // namespace photonproof::inline harness_bench
