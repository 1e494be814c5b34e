#include "harness/conclusions/paired_rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/statistics/statistics.h"

namespace photonproof::inline harness_conclusions {
namespace {

// Median and interval of ratios, from their logarithms.
Estimate exponentiated(const Estimate& logarithm) {
  Estimate ratio{std::exp(logarithm.value), {}};
  if (logarithm.interval) ratio.interval = {std::exp(logarithm.interval->low), std::exp(logarithm.interval->high)};
  return ratio;
}

std::string too_few(std::size_t rounds, std::size_t least) {
  return fmt::format("{} round{} of at least {}", rounds, rounds == 1 ? "" : "s", least);
}

void decide(RatioVerdict& verdict, double threshold) {
  verdict.change = side_of(*verdict.ratio.interval, threshold);
  if (verdict.change == Change::inconclusive)
    verdict.reason = fmt::format("the interval holds the threshold of {:.3g} %", 100 * threshold);
}

}  // namespace

Change side_of(const Interval& ratio, double threshold) {
  if (ratio.low > 1 + threshold) return Change::regression;
  if (ratio.high < 1 - threshold) return Change::improvement;
  return ratio.low >= 1 - threshold && ratio.high <= 1 + threshold ? Change::unchanged : Change::inconclusive;
}

std::string ratio_text(const Estimate& ratio) {
  if (!ratio.interval) return fmt::format("{:.3f}", ratio.value);
  return fmt::format("{:.3f} (95 % interval {:.3f} to {:.3f})", ratio.value, ratio.interval->low, ratio.interval->high);
}

RatioVerdict judge_seconds(std::span<const PairedRound> rounds, const ChangeThresholds& thresholds) {
  RatioVerdict verdict;
  verdict.ratio.value = 1;
  if (rounds.empty()) {
    verdict.reason = too_few(0, thresholds.least_rounds);
    return verdict;
  }
  std::vector<double> changes, controls;
  for (const PairedRound& round : rounds) {
    changes.push_back(std::log(2 * round.new_seconds / (round.old_seconds + round.again_seconds)));
    controls.push_back(std::log(round.again_seconds / round.old_seconds));
  }
  verdict.ratio = exponentiated(estimated_median(changes));
  const Estimate control = exponentiated(estimated_median(controls));
  verdict.control = control.interval;
  if (rounds.size() < thresholds.least_rounds || !verdict.ratio.interval) {
    verdict.reason = too_few(rounds.size(), thresholds.least_rounds);
  } else if (control.interval->low > 1 || control.interval->high < 1) {
    verdict.reason = "this session is noisy: the old program against itself is " + ratio_text(control);
  } else {
    decide(verdict, thresholds.seconds);
  }
  return verdict;
}

std::optional<RatioVerdict> judge_relmse(std::span<const PairedRound> rounds, const ChangeThresholds& thresholds) {
  const auto has_errors = [](const PairedRound& round) { return round.old_relmse && round.new_relmse; };
  if (rounds.empty() || !std::all_of(rounds.begin(), rounds.end(), has_errors)) return std::nullopt;
  RatioVerdict verdict;
  if (std::all_of(rounds.begin(), rounds.end(), [](const PairedRound& round) { return round.same_image; })) {
    verdict.ratio = {1, Interval{1, 1}};
    verdict.change = Change::unchanged;
    return verdict;
  }
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < rounds.size(); ++i) all.push_back(i);
  const auto logarithm = [&](std::span<const std::size_t> indices) {
    double was = 0, is = 0;
    for (const std::size_t i : indices) {
      was += *rounds[i].old_relmse;
      is += *rounds[i].new_relmse;
    }
    return std::log(is / was);
  };
  const double total = logarithm(all);
  if (!std::isfinite(total)) {
    verdict.ratio.value = 1;
    verdict.reason = "an error of 0 has no ratio";
    return verdict;
  }
  Estimate change{total, {}};
  if (rounds.size() >= thresholds.least_rounds) change.interval = jackknife_interval(rounds.size(), logarithm);
  verdict.ratio = exponentiated(change);
  if (!change.interval)
    verdict.reason = too_few(rounds.size(), thresholds.least_rounds);
  else
    decide(verdict, thresholds.relmse);
  return verdict;
}

}  // namespace photonproof::inline harness_conclusions
