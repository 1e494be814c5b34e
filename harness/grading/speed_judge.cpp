#include "harness/grading/speed_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/statistics/student.h"

namespace photonproof::inline harness_grading {
namespace {

// A tier counts if an interval of at most this width reaches it; with a wider one only the certain tier counts.
constexpr double generous_width = 0.5;
constexpr double speed_tail = 0.005;  // tail probability of each side, for all looks together

std::size_t next_look(std::size_t rounds) { return (3 * rounds + 1) / 2; }

// The number of looks within this many rounds, always including the last round.
int looks_within(std::size_t most) {
  int looks = 1;
  for (std::size_t rounds = least_speed_rounds; rounds < most; rounds = next_look(rounds)) ++looks;
  return looks;
}

bool is_quiet(const SpeedRound& round, int cores) { return round.busy <= tolerated_busy_share * cores; }

// The estimate from logarithms of ratios; no interval for one value.
Estimate ratio_estimate(const std::vector<double>& logarithms, double tail) {
  const auto n = static_cast<double>(logarithms.size());
  double mean = 0, squares = 0;
  for (const double value : logarithms) mean += value / n;
  for (const double value : logarithms) squares += (value - mean) * (value - mean);
  Estimate ratio{std::exp(mean), {}};
  if (logarithms.size() < 2) return ratio;
  const double margin = t_quantile(tail, n - 1) * std::sqrt(squares / (n - 1) / n);
  ratio.interval = {std::exp(mean - margin), std::exp(mean + margin)};
  return ratio;
}

std::vector<double> logarithms_of(const std::vector<const SpeedRound*>& rounds, std::size_t scene) {
  std::vector<double> values;
  for (const SpeedRound* round : rounds)
    values.push_back(std::log(round->baseline_seconds[scene] / round->seconds[scene]));
  return values;
}

// The tier whose beginning lies within the interval.
const SpeedTier* open_tier(const PerformanceRule& rule, const Interval& interval) {
  for (const SpeedTier& tier : rule.tiers)
    if (interval.low < tier.ratio && tier.ratio <= interval.high) return &tier;
  return nullptr;
}

// With a curve the score follows from the ratio itself.
std::optional<double> precision_of(const PerformanceRule& rule) {
  return !rule.precision && rule.curve ? std::optional(narrow_width) : rule.precision;
}

double relative_width(const Interval& interval) { return interval.high / interval.low - 1; }

// A ratio known to 2 % is printed as one number, another one by the ends of its interval.
std::string ratio_sentence(const Estimate& ratio) {
  if (!ratio.interval) return fmt::format("{:.3g} times as fast as the baseline", ratio.value);
  const auto [low, high] = *ratio.interval;
  if (relative_width(*ratio.interval) <= narrow_width)
    return fmt::format("{:.3g} times as fast as the baseline ({:.3g} to {:.3g})", ratio.value, low, high);
  return fmt::format("about {:.3g} times as fast as the baseline, between {:.3g} and {:.3g}", ratio.value, low, high);
}

std::vector<const SpeedRound*> counted_rounds(const std::vector<SpeedRound>& rounds, int cores, bool& disturbed) {
  std::vector<const SpeedRound*> quiet, all;
  for (const SpeedRound& round : rounds) {
    all.push_back(&round);
    if (is_quiet(round, cores)) quiet.push_back(&round);
  }
  disturbed = quiet.size() < least_speed_rounds && quiet.size() < all.size();
  return disturbed ? all : quiet;
}

bool is_wide(const SpeedGrade& grade) {
  return grade.state != SpeedGrade::State::measured &&
         (!grade.speedup.interval || relative_width(*grade.speedup.interval) > generous_width);
}

// The speed-up that earns points. A program must not profit from noise, its own or the machine's.
double counted_ratio(const SpeedGrade& grade, const SpeedTier* open) {
  if (is_wide(grade)) return grade.speedup.interval ? grade.speedup.interval->low : 0;
  return open != nullptr ? open->ratio : grade.speedup.value;
}

std::string noise_reason(const PerformanceRule& rule, const SpeedGrade& grade,
                         const std::vector<const SpeedRound*>& rounds, bool disturbed, int cores) {
  if (disturbed) {
    double busy = 0;
    for (const SpeedRound* round : rounds) busy += round->busy / static_cast<double>(rounds.size());
    return fmt::format("other work used {:.2g} of {} cores meanwhile", busy, cores);
  }
  if (rounds.size() < least_speed_rounds)
    return fmt::format("{} of at least {} rounds", rounds.size(), least_speed_rounds);
  const SpeedTier* const tier = rule.curve || is_wide(grade) ? nullptr : open_tier(rule, *grade.speedup.interval);
  if (tier != nullptr)
    return fmt::format("the interval contains {:.3g} times, where {:.3g} points begin; this counts as reached",
                       tier->ratio, tier->points);
  return fmt::format("the interval is {:.2g} % wide; at most {:.2g} % are asked for",
                     100 * relative_width(*grade.speedup.interval), 100 * precision_of(rule).value_or(narrow_width));
}

void fill_scenes(const std::vector<std::string>& scenes, const std::vector<SpeedRound>& rounds,
                 const std::vector<const SpeedRound*>& counted, double tail, SpeedGrade& grade) {
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    SceneSpeed speed;
    speed.scene = scenes[s];
    speed.ratio = ratio_estimate(logarithms_of(counted, s), tail);
    for (const SpeedRound& round : rounds) {
      speed.baseline_seconds.push_back(round.baseline_seconds[s]);
      speed.seconds.push_back(round.seconds[s]);
      speed.busy.push_back(round.busy);
    }
    grade.scenes.push_back(std::move(speed));
  }
}

}  // namespace

bool is_speed_look(std::size_t rounds) {
  std::size_t look = least_speed_rounds;
  while (look < rounds) look = next_look(look);
  return look == rounds;
}

double points_for(const PerformanceRule& rule, double speedup) {
  if (rule.curve) return rule.curve->points * std::clamp(std::log(speedup) / std::log(rule.curve->ratio), 0.0, 1.0);
  double points = 0;
  for (const SpeedTier& tier : rule.tiers)
    if (speedup >= tier.ratio) points = tier.points;
  return points;
}

std::string rule_text(const PerformanceRule& rule) {
  if (rule.curve)
    return fmt::format("{:.4g} points at {:.4g}x, by the logarithm below", rule.curve->points, rule.curve->ratio);
  std::string text;
  for (const SpeedTier& tier : rule.tiers)
    text += fmt::format("{}{:.4g}{} from {:.4g}x", text.empty() ? "" : ", ", tier.points, text.empty() ? " points" : "",
                        tier.ratio);
  return text;
}

SpeedJudgement judge_speed(const PerformanceRule& rule, const std::vector<std::string>& scenes,
                           const std::vector<SpeedRound>& rounds, int cores, bool last) {
  SpeedJudgement judgement;
  SpeedGrade& grade = judgement.grade;
  if (rounds.empty()) {
    grade.sentence = "not timed: time ran out";
    return judgement;
  }
  bool disturbed = false;
  const std::vector<const SpeedRound*> counted = counted_rounds(rounds, cores, disturbed);
  grade.rounds = static_cast<int>(counted.size());
  const double tail = speed_tail / looks_within(static_cast<std::size_t>(rule.rounds));
  fill_scenes(scenes, rounds, counted, tail, grade);
  std::vector<double> together(counted.size(), 0.0);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const std::vector<double> logarithms = logarithms_of(counted, s);
    for (std::size_t r = 0; r < counted.size(); ++r) together[r] += logarithms[r] / static_cast<double>(scenes.size());
  }
  grade.speedup = ratio_estimate(together, tail);
  const bool enough = counted.size() >= least_speed_rounds && !disturbed;
  const bool looked = enough && (last || is_speed_look(counted.size()));
  const double width = enough ? relative_width(*grade.speedup.interval) : 0;
  const SpeedTier* const open = enough && !rule.curve ? open_tier(rule, *grade.speedup.interval) : nullptr;
  const std::optional<double> precision = precision_of(rule);
  judgement.decided = looked && open == nullptr && (!precision || width <= *precision);
  grade.state = judgement.decided ? SpeedGrade::State::measured : SpeedGrade::State::too_noisy;
  grade.sentence = ratio_sentence(grade.speedup);
  if (!judgement.decided && last)
    grade.sentence += "; too noisy: " + noise_reason(rule, grade, counted, disturbed, cores);
  if (last && is_wide(grade))
    grade.sentence += grade.speedup.interval
                          ? fmt::format("; points are for the lower end, {:.3g} times", grade.speedup.interval->low)
                          : std::string("; no points without an interval");
  grade.points = points_for(rule, counted_ratio(grade, open));
  if (looked && width <= std::min(narrow_width, precision.value_or(narrow_width))) judgement.decided = true;
  return judgement;
}

}  // namespace photonproof::inline harness_grading
