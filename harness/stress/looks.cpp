#include "harness/stress/looks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace photonproof::inline harness_stress {
namespace {

constexpr int looks_at_noise = 3;
constexpr int most_times = 8, next_times = 4, expected_times = 4;
constexpr double reach = 2;  // factor on the square of the noise

/// The noise that hides an error is `of_look` + `of_expected`, squares of relative errors; `quiet` is the limit for it.
std::optional<LevelLook> look_at_noise(double of_look, double of_expected, double quiet, const LevelLook& last,
                                       double most_samples) {
  const auto may_have = [&](int times) {
    return times * last.samples <= most_samples || (last.number < looks_at_noise && times <= next_times);
  };
  LevelLook next{last.number + 1, last.samples, last.expected_from};
  const double least = (of_look * last.samples + of_expected * last.expected_from) / most_samples;
  if (least > reach * quiet) {
    if (last.number >= looks_at_noise) return {};
    next.samples *= next_times;
    return next;
  }
  if (of_expected > quiet / 2 && expected_times * last.expected_from <= most_samples / 2) {
    next.expected_from *= expected_times;
    of_expected /= expected_times;
  }
  const double left = quiet - of_expected;
  const double needed = left > 0 ? last.samples * of_look / left : std::numeric_limits<double>::infinity();
  int times = 1;
  while (times < most_times && times * last.samples < needed && may_have(2 * times)) times *= 2;
  next.samples *= times;
  if (times == 1 && next.expected_from == last.expected_from) return {};
  return next;
}

}  // namespace

std::optional<LevelLook> next_look(const LevelVerdict& verdict, const LevelLook& last, double most_samples) {
  if (verdict.outcome != LevelOutcome::silently_wrong && verdict.outcome != LevelOutcome::degraded &&
      verdict.outcome != LevelOutcome::undecided)
    return {};
  if (verdict.is_wrong || !verdict.would_see) {
    if (last.number > 1) return {};
    const int times = next_times * last.samples <= most_samples ? next_times : 1;
    return LevelLook{last.number + 1, times * last.samples, last.expected_from};
  }
  const auto squared = [&](double error) { return std::pow(std::max(error - verdict.allowed, 0.0), 2); };
  const double noise = squared(*verdict.would_see), of_expected = verdict.share_of_expected * noise;
  return look_at_noise(noise - of_expected, of_expected, squared(level_power), last, most_samples);
}

}  // namespace photonproof::inline harness_stress
